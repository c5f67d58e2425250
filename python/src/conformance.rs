//! Check of a driver in Python against the laws of drivers.

use std::ops::ControlFlow;
use std::os::fd::IntoRawFd;
use std::os::unix::net::UnixStream;

use motet::conformance::{SAY, check, first_call};
use motet::host::remote::protocol::Hello;
use motet::host::remote::{DriverLog, DriverTimeouts, RemoteDriver};
use motet::run::{run_id, state_facts};
use motet::runtime::Time;
use pyo3::prelude::*;

use crate::errors::raised;
use crate::findings::Findings;
use crate::project::Project;

/// Scenes with their broken laws, each a law with what happened, and the last messages.
type Scenes = Vec<(String, Vec<(String, String)>, Vec<String>)>;

#[pymethods]
impl Project {
    /// Leads drivers through the scenes of the conformance suite with the first call of a policy, or of one
    /// that says something. `serve` gets the number of a socket and serves a fresh driver on it. Gives the
    /// scenes; none where the check refuses the policy.
    #[pyo3(signature = (name, document, policy, *, serve, patience))]
    fn check_driver(
        &self,
        py: Python<'_>,
        name: &str,
        document: Option<&[u8]>,
        policy: Option<String>,
        serve: Py<PyAny>,
        patience: Option<f64>,
    ) -> PyResult<(Option<Scenes>, Findings)> {
        let (prepared, findings) = self.compile(py, name, document, policy)?;
        let Some(prepared) = prepared else { return Ok((None, findings)) };
        let unusable = |why| raised(py, "InputError", (why, None::<String>, ""));
        let command = first_call(&prepared.graph).map_err(unusable)?;
        let (mut scenes, mut interrupt) = (Scenes::new(), None);
        let checked = py.detach(|| {
            let mut connect = |log: Box<dyn DriverLog>| {
                let (own, theirs) = UnixStream::pair().map_err(|error| error.to_string())?;
                let file = theirs.into_raw_fd();
                Python::attach(|py| serve.call1(py, (file,))).map_err(|error| error.to_string())?;
                let state = state_facts(&prepared.opened);
                let hello = Hello { state, ..Hello::of(&prepared.graph, &run_id()) };
                RemoteDriver::over_stream(own, hello, DriverTimeouts::default(), Time::ZERO, log)
                    .map_err(|broken| broken.to_string())
            };
            check(command, patience, Box::new(|_: &str| {}), &mut connect, &mut |scene| {
                let broken = scene.broken.into_iter().map(|(law, told)| (law.to_owned(), told));
                scenes.push((scene.name.to_owned(), broken.collect(), scene.messages.into()));
                interrupt = Python::attach(|py| py.check_signals()).err();
                if interrupt.is_some() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            })
        });
        if let Some(interrupt) = interrupt {
            return Err(interrupt);
        }
        checked.map_err(unusable)?;
        Ok((Some(scenes), findings))
    }
}

/// The steps of a policy whose call harms nothing and nobody.
#[pyfunction]
pub(crate) fn harmless_steps() -> &'static str {
    SAY
}
