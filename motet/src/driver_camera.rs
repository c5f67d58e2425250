//! Pictures of the robot's camera, for a planner that looks before it plans.

use std::cell::RefCell;
use std::rc::Rc;

use motet_host::remote::RemoteDriver;
use motet_runtime::{CameraImage, Perception, RgbdView, Time};
use motet_sim::Sim;

/// Pictures of a driver that somebody else drives.
#[derive(Clone)]
pub enum DriverCamera {
    /// Simulator, whose camera turns to what is worth to be seen.
    Simulator(Rc<RefCell<Sim>>),
    /// Driver process, whose camera looks where it is turned.
    Process(Rc<RefCell<RemoteDriver>>),
}

impl Perception for DriverCamera {
    fn image(&mut self, now: Time) -> Option<CameraImage> {
        match self {
            Self::Simulator(simulator) => simulator.image(now),
            Self::Process(driver) => driver.image(now),
        }
    }

    fn view(&mut self, now: Time, of: &str) -> Option<RgbdView> {
        match self {
            Self::Simulator(simulator) => simulator.view(now, of),
            Self::Process(driver) => driver.view(now, of),
        }
    }
}
