//! Everything that changes during a run, in flat tables by node, region, watch and binding.

use crate::belief::{Beliefs, CellId};
use crate::cleanup::PendingCleanup;
use crate::effect::{Command, DeferredMotion, RunEnd};
use crate::event::Verification;
use crate::ids::{CheckId, GoalId, GoalTable};
use crate::prepared_graph::{PreparedGraph, Table};
use crate::query::Truth;
use crate::schedule::{NodeExit, Timers, WorkList};
use crate::time::Time;
use crate::trace::EndCause;
use motet_graph::{Graph, NodeId, RegionId, Value};
use rustc_hash::FxHashMap;
use smol_str::SmolStr;
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::sync::Arc;

/// Position where a step is in its life.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Phase {
    /// Not reached, or over.
    Idle,
    /// To be entered, or a call to be started: the work list holds it.
    Entering,
    /// To be entered once what suspends it goes on.
    Parked,
    /// Over: the work list holds its end.
    Ending,
    /// A composite with a region running.
    Inside,
    /// An `if` or a loop whose test awaits observations.
    Deciding,
    Waiting,
    /// A call that waits for its resources.
    Queued,
    /// A call that has its resources and awaits observations for its guards.
    Checking,
    /// A call whose goal is not acknowledged.
    Starting,
    /// A call whose goal runs.
    Running,
    /// A call whose goal was told to hold.
    Held,
    /// A call whose goal was told to end early.
    Cancelling,
    /// A call whose goal was told to stop safely.
    SafeStopping,
    /// A call without a goal, which starts again once what suspends it goes on.
    Suspended,
}

impl Phase {
    /// True if a goal is live.
    pub(crate) const fn has_goal(self) -> bool {
        match self {
            Self::Starting | Self::Running | Self::Held | Self::Cancelling | Self::SafeStopping => true,
            Self::Idle | Self::Entering | Self::Parked | Self::Ending | Self::Inside | Self::Deciding => {
                false
            }
            Self::Waiting | Self::Queued | Self::Checking | Self::Suspended => false,
        }
    }
}

/// Pending intent for a goal: reason for an early end, or action after its acknowledgement.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum GoalIntent {
    None,
    Hold,
    /// The driver lost it: it fails once it is safe.
    Lose,
    /// It is interrupted and starts again later.
    Suspend,
    /// It took too long.
    Expire,
    /// Its step is over.
    Stop,
}

/// Continuation of a node after the regions that it stops have ended.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum AfterStop {
    /// Nothing is being stopped.
    Nothing,
    Exit(NodeExit),
    /// A monitor starts its body again.
    Restart,
}

/// A step's state. What a field means depends on the node's kind.
#[derive(Clone, Debug)]
pub(crate) struct NodeRun {
    pub(crate) phase: Phase,
    pub(crate) wish: GoalIntent,
    /// Call: attempts begun. Loop: runs of the body begun.
    pub(crate) count: u32,
    /// Call: it was interrupted after it had begun, and begins again.
    pub(crate) begins_again: bool,
    pub(crate) goal: Option<GoalId>,
    /// Time at which the observations that count began.
    pub(crate) since: Time,
    /// Number of observations until then.
    pub(crate) seen: u64,
    /// Remaining time of a deadline while the step is suspended.
    pub(crate) left: Time,
    /// True if the work list holds a judgement of it.
    pub(crate) judging: bool,
}

/// Additional state of a composite step; apart, because few steps need it.
#[derive(Clone, Debug)]
pub(crate) struct CompositeRun {
    pub(crate) after: AfterStop,
    /// Monitor: pauses in force.
    pub(crate) pauses: u32,
    /// Monitor: the watch whose block runs or is about to.
    pub(crate) resuming: Option<u32>,
    /// Monitor: how the body ended while it was interrupted. Step with a cleanup: how the body ended, while
    /// the cleanup runs.
    pub(crate) body_ended: Option<NodeExit>,
}

/// A region's state.
#[derive(Clone, Debug)]
pub(crate) struct RegionRun {
    pub(crate) active: bool,
    pub(crate) current: Option<NodeId>,
    /// Cause of a stop in progress.
    pub(crate) stopping: Option<EndCause>,
    /// By how many pauses and interruptions it is suspended.
    pub(crate) suspended: u32,
}

/// A watch's state.
#[derive(Clone, Debug)]
pub(crate) struct WatchRun {
    /// Time at which the monitor was entered.
    pub(crate) since: Time,
    /// Since when its condition has been true.
    pub(crate) true_since: Option<Time>,
    /// Since when its condition has not been false.
    pub(crate) open_since: Option<Time>,
    pub(crate) truth: Truth,
    /// Since when it pauses the body.
    pub(crate) paused_at: Option<Time>,
    /// Total of its earlier pauses.
    pub(crate) spent: Time,
    /// Number of times it has fired.
    pub(crate) fired: u32,
    pub(crate) dirty: bool,
}

/// A motion whose verdict a call awaits, or has had.
#[derive(Clone, Debug)]
pub(crate) struct MotionCheck {
    pub(crate) id: CheckId,
    pub(crate) node: NodeId,
    pub(crate) motion: Arc<DeferredMotion>,
    pub(crate) verdict: Option<Verification>,
}

/// The state of a run.
#[derive(Clone, Debug)]
pub(crate) struct Run {
    pub(crate) begun: bool,
    pub(crate) over: bool,
    pub(crate) now: Time,
    pub(crate) revision: u32,
    pub(crate) nodes: Table<NodeRun>,
    pub(crate) composites: Table<CompositeRun>,
    pub(crate) regions: Table<RegionRun>,
    pub(crate) watches: Table<WatchRun>,
    /// Queries that each watch and each `wait` keeps watched.
    pub(crate) subscriptions: Table<Vec<CellId>>,
    pub(crate) bindings: Vec<Option<Value>>,
    /// Lists that `each` loops run over, innermost last.
    pub(crate) lists: Vec<(NodeId, Arc<[Value]>)>,
    pub(crate) beliefs: Beliefs,
    pub(crate) goals: GoalTable,
    /// Commands of live goals whose arguments had to be worked out.
    pub(crate) commands: Vec<(NodeId, Arc<Command>)>,
    pub(crate) timers: Timers,
    /// Resources that are held, as bits.
    pub(crate) held: u128,
    /// Calls that wait for resources, in document order.
    pub(crate) queue: Vec<NodeId>,
    /// True if a resource became free since the queue was last looked at.
    pub(crate) freed: bool,
    /// Monitors that wait for their body to be down before they run a block.
    pub(crate) clearing: Vec<NodeId>,
    /// True if a step found another thing than the proofs assume: what they proved is checked from then on.
    pub(crate) is_unproven: bool,
    /// True once a `wait` began whose condition was believed to be false. It lets the world undo what steps
    /// made, so a guard asks before it refuses.
    pub(crate) looks_afresh: bool,
    /// True once a test has seen that something dropped: the world has undone what steps made, so guards ask
    /// for all that they need.
    pub(crate) is_undone: bool,
    /// Motions of calls that are about to start.
    pub(crate) checks: Vec<MotionCheck>,
    /// Number of checks so far.
    pub(crate) checked: u64,
    /// Observations that steps await.
    pub(crate) asked: Vec<(CellId, NodeId)>,
    /// Facts about hands that tests have asked for and nobody has answered, also where the test has ended.
    pub(crate) hands_asked: Vec<CellId>,
    pub(crate) work: WorkList,
    pub(crate) dirty: BinaryHeap<Reverse<u32>>,
    /// Outcome of the run after all regions have ended.
    pub(crate) ending: Option<RunEnd>,
    /// True if a person stopped the run: no cleanup runs any more.
    pub(crate) halted: bool,
    /// True while a person wants everything to keep still.
    pub(crate) is_held_by_person: bool,
    /// Cleanups of earlier policies that have not run to their end.
    pub(crate) left: Vec<PendingCleanup>,
    /// Steps whose cleanup did not run, or not to its end.
    pub(crate) uncleaned: Vec<NodeId>,
    /// Outcome of the run, and the step in which it arose, while the policy's goal is observed.
    pub(crate) reached: Option<(RunEnd, NodeId)>,
    /// Outcome of the run after the goals of replaced policies have ended.
    pub(crate) closing: Option<RunEnd>,
    /// Goals of replaced policies, by start.
    pub(crate) orphans: Vec<OrphanGoal>,
    /// True if a swap is being made: watches that lose their last watcher are kept until it is.
    pub(crate) swapping: bool,
    pub(crate) idle: Vec<CellId>,
    /// Causes of failures in words, by the step in which a failure arose.
    pub(crate) reasons: FxHashMap<NodeId, SmolStr>,
    /// Names of failures, those that drivers made up last.
    pub(crate) failures: Vec<SmolStr>,
    /// Scratch for walks over regions.
    pub(crate) walk: Vec<RegionId>,
    pub(crate) missing: Vec<CellId>,
}

impl Run {
    /// Before the beginning.
    pub(crate) fn new(plan: &PreparedGraph, beliefs: Beliefs) -> Self {
        let node = NodeRun {
            phase: Phase::Idle,
            wish: GoalIntent::None,
            count: 0,
            begins_again: false,
            goal: None,
            since: Time::ZERO,
            seen: 0,
            left: Time::ZERO,
            judging: false,
        };
        let composite =
            CompositeRun { after: AfterStop::Nothing, pauses: 0, resuming: None, body_ended: None };
        let region = RegionRun { active: false, current: None, stopping: None, suspended: 0 };
        let watch = WatchRun {
            since: Time::ZERO,
            true_since: None,
            open_since: None,
            truth: Truth::Unknown,
            paused_at: None,
            spent: Time::ZERO,
            fired: 0,
            dirty: false,
        };
        Self {
            begun: false,
            over: false,
            now: Time::ZERO,
            revision: 0,
            // One more for the goal.
            nodes: Table::new(plan.graph.nodes.len() + 1, node),
            composites: Table::new(plan.graph.nodes.len(), composite),
            regions: Table::new(plan.graph.regions.len(), region),
            watches: Table::new(plan.watches.len(), watch),
            subscriptions: Table::new(plan.keys(), Vec::new()),
            bindings: vec![None; plan.graph.bindings.len()],
            lists: Vec::new(),
            beliefs,
            goals: GoalTable::default(),
            commands: Vec::new(),
            timers: Timers::new(plan.keys()),
            held: 0,
            queue: Vec::new(),
            freed: false,
            clearing: Vec::new(),
            checks: Vec::new(),
            checked: 0,
            asked: Vec::new(),
            hands_asked: Vec::new(),
            work: WorkList::default(),
            dirty: BinaryHeap::new(),
            ending: None,
            halted: false,
            is_held_by_person: false,
            is_unproven: false,
            looks_afresh: false,
            is_undone: false,
            left: Vec::new(),
            uncleaned: Vec::new(),
            reached: None,
            closing: None,
            orphans: Vec::new(),
            swapping: false,
            idle: Vec::new(),
            reasons: FxHashMap::default(),
            failures: plan.failures.clone(),
            walk: Vec::new(),
            missing: Vec::new(),
        }
    }

    /// Command of a call's goal; `None` without a goal.
    pub(crate) fn command(&self, plan: &PreparedGraph, node: NodeId) -> Option<Arc<Command>> {
        let worked_out = self.commands.iter().find(|(of, _)| *of == node).map(|(_, command)| command);
        worked_out.or(plan.step(node).command.as_ref()).cloned()
    }
}

/// A goal without a step. It holds its resources until it has ended.
#[derive(Clone, Debug)]
pub(crate) struct OrphanGoal {
    pub(crate) goal: GoalId,
    pub(crate) command: Arc<Command>,
    pub(crate) phase: Phase,
    pub(crate) wish: GoalIntent,
    /// Time at which its cancel or its safe stop will have taken too long.
    pub(crate) due: Time,
    /// Its resources, as bits of the present graph.
    pub(crate) uses: u128,
    /// The number of the graph that started it.
    pub(crate) revision: u32,
    /// Its step in that graph.
    pub(crate) node: NodeId,
    /// Number of the last observation or effect before it began.
    pub(crate) seen: u64,
    pub(crate) plan: Arc<PreparedGraph>,
    /// Bindings at the time when that graph was replaced.
    pub(crate) bindings: Arc<Vec<Option<Value>>>,
}

impl OrphanGoal {
    /// True if it may go on for a step of the new graph: nothing has been said against it.
    pub(crate) fn is_free(&self) -> bool {
        matches!(self.wish, GoalIntent::None | GoalIntent::Hold)
            && matches!(self.phase, Phase::Starting | Phase::Running | Phase::Held)
    }

    /// Its resources as bits of another graph. Of one that the other does not know, what it contains and what
    /// contains it counts: rather too much than too little.
    pub(crate) fn uses_in(&self, graph: &Graph) -> u128 {
        let own = &self.plan.graph.resources;
        let bit = |name: &str| {
            let index = graph.resources.iter().position(|resource| resource.name == name);
            index.and_then(|index| 1_u128.checked_shl(index as u32)).unwrap_or(0)
        };
        self.command.uses.iter().fold(0, |bits, name| {
            let same = bit(name);
            if same != 0 {
                return bits | same;
            }
            let Some(place) = own.iter().position(|resource| resource.name == *name) else { return bits };
            let related = own.iter().enumerate().filter(|(index, other)| {
                other.contains.iter().any(|inner| inner.index() == place)
                    || own
                        .get(place)
                        .is_some_and(|used| used.contains.iter().any(|inner| inner.index() == *index))
            });
            related.fold(bits, |bits, (_, other)| bits | bit(&other.name))
        })
    }
}
