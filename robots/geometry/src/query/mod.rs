//! Motion queries: whether a robot in a world can do a motion, with the motion as the witness.
//!
//! A [`Machine`] is made once for a robot, a [`Room`] once for a [`World`]; then [`Room::answer`] answers any number of queries.
//! A feasible answer is a path of which every leg was certified free, so it holds for the shapes that the card and the scene
//! give. An infeasible answer says whether it is proven. What is not computed is unknown, and says why.

mod after;
mod answer;
mod arm;
mod around;
mod barrier;
mod cells;
mod connect;
mod excursion;
mod follow;
mod go;
mod grasp;
mod grip;
mod help;
mod lead;
mod look;
mod machine;
mod map;
mod margin;
mod obstacle;
mod offer;
mod opened;
mod opening;
mod outlines;
mod palm;
mod pull;
mod push;
mod put;
mod quick;
mod reach;
mod room;
mod screen;
mod seek;
mod shrunk;
mod shut;
mod solver;
mod span;
mod state;
mod things;
mod touch;
mod travel;
mod way;
mod world;

pub use answer::{
    Answer, Aside, Budget, Grasp, Infeasible, Margins, Query, Reason, Share, Side, Unknown, Witness,
};
pub use machine::{Hand, Machine};
pub use opening::Opening;
pub use room::{GAP, Maps, Room};
pub use solver::Solver;
pub use state::State;
pub use touch::{Allowed, Touch};
pub use world::{World, components};

impl Room<'_> {
    /// Answers a query in this room. The same room, query and budget give the same answer, bit for bit.
    #[must_use]
    pub fn answer(&self, query: &Query, budget: Budget) -> Answer {
        if let Some(why) = self.blind_spot() {
            return Answer::Unknown(Unknown::Because(why));
        }
        if let Some(Touch { link, other, .. }) = self.at_start() {
            return Answer::Unknown(Unknown::Because(format!("at the start `{link}` touches `{other}`")));
        }
        match query {
            Query::GoTo(to) => self.go_to(to, budget),
            Query::Reach(object, side) => self.reach(object, *side, budget),
            Query::Put(object, on) => self.put(object, on, budget),
            Query::Offer(object, to) => self.offer(object, to, budget),
            Query::Look(at) => self.look(at, budget),
            Query::Pull(what) => self.pull(what, [0.0, 1.0], budget),
            Query::Push(what) => self.push(what, budget),
            Query::Posture(name) => self.to_posture(name),
            Query::Other(name) => Answer::Unknown(Unknown::Because(format!("`{name}` is not computed yet"))),
        }
    }
}
