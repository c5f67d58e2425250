//! The program: a policy after name resolution and typing.

use motet_graph::Manner;
use motet_syntax::Span;
use motet_syntax::ast::{CompareOp, EndKind};
use motet_syntax::unit::Unit;
use smallvec::{SmallVec, smallvec};
use smol_str::SmolStr;

use super::{BindingId, Condition, Failure, Primitive, StepId, Term, Ty};

/// A policy after name resolution and typing.
#[derive(Clone, Debug, Default)]
pub(crate) struct Program {
    pub(crate) name: SmolStr,
    /// Name of the robot; empty without one.
    pub(crate) robot: SmolStr,
    pub(crate) span: Span,
    /// All steps, parents before children, in document order.
    pub(crate) steps: Vec<Step>,
    pub(crate) body: Block,
    pub(crate) bindings: Vec<Binding>,
    pub(crate) achieves: Option<(Condition, Span)>,
    /// Binding of the result, if the policy gives one.
    pub(crate) result: Option<BindingId>,
}

impl Program {
    /// The step with an id.
    pub(crate) fn step(&self, id: StepId) -> Option<&Step> {
        self.steps.get(id.index())
    }

    /// Returns whether something around a step can interrupt it: a monitor, or a sibling branch that fails.
    pub(crate) fn is_interruptible(&self, id: StepId) -> bool {
        let mut slot = self.step(id).map(|step| step.position.slot);
        self.around(id).any(|(_, outer)| {
            let inside = slot.replace(outer.position.slot);
            let Some(inside) = inside else { return false };
            matches!(
                inside,
                BlockSlot::During
                    | BlockSlot::Kept
                    | BlockSlot::KeptWhole
                    | BlockSlot::Timed
                    | BlockSlot::Reaction(_)
                    | BlockSlot::Branch(_)
            )
        })
    }

    /// Returns whether an ending of a step stands in a cleanup that it would leave: of the policy, or of the
    /// inlined policy `of`.
    pub(crate) fn leaves_cleanup(&self, id: StepId, of: Option<StepId>) -> bool {
        let mut slot = self.step(id).map(|step| step.position.slot);
        for (outer, step) in self.around(id) {
            if slot == Some(BlockSlot::Finally) {
                return true;
            }
            if Some(outer) == of {
                return false;
            }
            slot = Some(step.position.slot);
        }
        false
    }

    /// Rules of where the robot may not go during a step, innermost first. O(ancestors).
    pub(crate) fn kept(&self, id: StepId) -> impl Iterator<Item = Keep<'_>> {
        let mut slot = self.step(id).map(|step| step.position.slot);
        let around = self.around(id).filter_map(move |(_, outer)| {
            let inside = slot.replace(outer.position.slot);
            matches!(inside, Some(BlockSlot::Kept | BlockSlot::KeptWhole)).then_some(&outer.kind)
        });
        let conditions = around.flat_map(StepKind::conditions);
        conditions.filter_map(Keep::new)
    }

    /// Ancestors of a step, innermost first.
    pub(crate) fn around(&self, id: StepId) -> impl Iterator<Item = (StepId, &Step)> {
        let outer = |id: StepId| {
            let id = self.step(id)?.position.parent?;
            Some((id, self.step(id)?))
        };
        std::iter::successors(outer(id), move |(id, _)| outer(*id))
    }
}

/// Steps that run one after the other.
pub(crate) type Block = Vec<StepId>;

/// Rule of where the robot may not go, as the conditions of its monitor say it.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Keep<'p> {
    /// Zone that nothing of the robot enters.
    OutOf(&'p Term),
    Distance {
        to: &'p Term,
        /// Least distance in m; `None` if only the run determines it.
        at_least: Option<f64>,
    },
}

impl<'p> Keep<'p> {
    /// The rule whose monitor has a condition.
    pub(crate) fn new(condition: &'p Condition) -> Option<Self> {
        let Condition::Compare(op, Term::Measure(_, args), limit) = condition else { return None };
        let to = args.first()?;
        Some(match (op, limit) {
            (CompareOp::AtMost, _) => Self::OutOf(to),
            (_, Term::Number(at_least)) => Self::Distance { to, at_least: Some(*at_least) },
            _ => Self::Distance { to, at_least: None },
        })
    }
}

/// A name for the result of a step.
#[derive(Clone, Debug)]
pub(crate) struct Binding {
    /// `_` for a result without a name.
    pub(crate) name: SmolStr,
    pub(crate) ty: Ty,
    /// The name where it is bound first.
    pub(crate) span: Span,
    /// Literal descriptions in the perceptions that find it, one for each path to its uses; `None` if one of
    /// them has none.
    pub(crate) descriptions: Option<SmallVec<[SmolStr; 1]>>,
    /// Steps that bind it, one for each path to its uses.
    pub(crate) binders: SmallVec<[StepId; 1]>,
    /// True for a parameter of a sub-policy that is checked alone.
    pub(crate) is_param: bool,
    /// Number of uses.
    pub(crate) uses: u32,
    /// Places that bind it on paths without a use of their own, each with the number of uses where the paths
    /// met: more uses are for all of them.
    pub(crate) idle: Vec<(Span, u32)>,
}

impl Binding {
    /// Takes in the bindings of the same name and type on the other paths that meet here.
    pub(crate) fn merge(&mut self, others: Vec<Self>) {
        let uses = others.iter().fold(self.uses, |uses, other| uses + other.uses);
        let mut idle = Vec::new();
        for path in std::iter::once(&*self).chain(&others) {
            idle.extend(path.unused().map(|span| (span, uses)));
        }
        (self.idle, self.uses) = (idle, uses);
        for other in others {
            self.binders.extend(other.binders);
            let described = self.descriptions.take().zip(other.descriptions);
            self.descriptions = described.map(|(mut all, more)| {
                all.extend(more);
                all
            });
        }
        if let Some(descriptions) = &mut self.descriptions {
            descriptions.sort_unstable();
            descriptions.dedup();
        }
    }

    /// Places where it is bound and never used.
    pub(crate) fn unused(&self) -> impl Iterator<Item = Span> {
        let whole = (self.uses == 0 && self.idle.is_empty()).then_some(self.span);
        let parts = self.idle.iter().filter(|(_, uses)| *uses == self.uses).map(|(span, _)| *span);
        whole.into_iter().chain(parts)
    }
}

/// A step with its position.
#[derive(Clone, Debug)]
pub(crate) struct Step {
    pub(crate) kind: StepKind,
    pub(crate) span: Span,
    pub(crate) position: StepPosition,
    /// Least and greatest duration in seconds; `limits` fills it in.
    pub(crate) bounds: (f64, f64),
}

/// Position of a step in the tree.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct StepPosition {
    /// The step around it; `None` in the body of the policy.
    pub(crate) parent: Option<StepId>,
    pub(crate) slot: BlockSlot,
    /// Index in that block, from 0.
    pub(crate) index: u32,
}

/// Blocks of a step.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum BlockSlot {
    /// `steps`: of a policy, a sequence, a loop.
    Steps,
    Then,
    Else,
    Try,
    Catch(u16),
    During,
    /// `steps` of a `within`.
    Timed,
    /// Block of a `keep`, which is a monitor.
    Kept,
    /// Block of the `keep` of a whole policy.
    KeptWhole,
    Reaction(u16),
    Branch(u16),
    /// Body of an inlined policy.
    Inlined,
    /// The step that a `finally` stands behind, or a whole policy with its cleanup.
    Protected,
    /// A whole inlined policy with its cleanup.
    InlinedWhole,
    Finally,
}

/// Kinds of steps.
#[derive(Clone, Debug)]
pub(crate) enum StepKind {
    Call(Call),
    /// Binds a name to a value.
    Let {
        binding: BindingId,
        value: Term,
    },
    Sequence {
        name: SmolStr,
        body: Block,
    },
    Inline {
        policy: SmolStr,
        body: Block,
    },
    If {
        condition: Condition,
        span: Span,
        then: Block,
        otherwise: Option<Block>,
    },
    /// Blocks until a condition holds.
    Wait {
        condition: Condition,
        within_secs: f64,
    },
    /// Blocks for a time.
    Delay {
        secs: f64,
    },
    /// A block with its cleanup, which runs once, however the block is left.
    Finally {
        body: Block,
        cleanup: Block,
    },
    /// A monitor, or a `within`, which is one that waits for nothing but time.
    Monitor {
        whens: Vec<When>,
        body: Block,
    },
    Try {
        body: Block,
        catches: Vec<Catch>,
    },
    Repeat {
        /// Maximal number of rounds.
        times: u32,
        body: Block,
        until: Option<(Condition, Span)>,
    },
    /// A loop over a list.
    Each {
        item: BindingId,
        list: Term,
        /// Maximal length of the list.
        at_most: u32,
        body: Block,
    },
    Parallel {
        branches: Vec<Block>,
    },
    /// Ends the policy or the inlined policy `of`.
    End {
        kind: EndKind,
        of: Option<StepId>,
        why: Option<Term>,
    },
    /// A step with an error: it may change any fact.
    Unknown,
}

impl StepKind {
    /// Blocks of the step, in document order.
    pub(crate) fn blocks(&self) -> SmallVec<[&Block; 2]> {
        match self {
            Self::Call(_) | Self::Let { .. } | Self::Wait { .. } | Self::Delay { .. } => SmallVec::new(),
            Self::End { .. } | Self::Unknown => SmallVec::new(),
            Self::Finally { body, cleanup } => smallvec![body, cleanup],
            Self::Sequence { body, .. }
            | Self::Inline { body, .. }
            | Self::Repeat { body, .. }
            | Self::Each { body, .. } => smallvec![body],
            Self::If { then, otherwise, .. } => std::iter::once(then).chain(otherwise).collect(),
            Self::Monitor { whens, body } => {
                let reactions = whens.iter().filter_map(|when| match &when.reaction {
                    Reaction::Resume { body, .. } => Some(body),
                    Reaction::Pause { .. } | Reaction::Timeout => None,
                    Reaction::Restart { .. } | Reaction::End { .. } => None,
                });
                reactions.chain([body]).collect()
            }
            Self::Try { body, catches } => {
                std::iter::once(body).chain(catches.iter().map(|catch| &catch.body)).collect()
            }
            Self::Parallel { branches } => branches.iter().collect(),
        }
    }

    /// The time in seconds that a `within` gives its body.
    pub(crate) fn deadline(&self) -> Option<f64> {
        let Self::Monitor { whens, .. } = self else { return None };
        let is_deadline = |when: &&When| matches!(when.reaction, Reaction::Timeout);
        whens.iter().find(is_deadline).map(|when| when.hold_secs)
    }

    /// Endings of the step itself, each with the inlined policy that it ends.
    pub(crate) fn endings(&self) -> SmallVec<[(EndKind, Option<StepId>); 1]> {
        match self {
            Self::End { kind, of, .. } => smallvec![(*kind, *of)],
            Self::Monitor { whens, .. } => {
                let endings = whens.iter().filter_map(|when| match &when.reaction {
                    Reaction::End { kind, of, .. } => Some((*kind, *of)),
                    Reaction::Pause { .. } | Reaction::Timeout => None,
                    Reaction::Restart { .. } | Reaction::Resume { .. } => None,
                });
                endings.collect()
            }
            Self::Call(_) | Self::Sequence { .. } | Self::Inline { .. } | Self::If { .. } => SmallVec::new(),
            Self::Let { .. } | Self::Wait { .. } | Self::Delay { .. } => SmallVec::new(),
            Self::Finally { .. } => SmallVec::new(),
            Self::Try { .. } | Self::Repeat { .. } | Self::Each { .. } => SmallVec::new(),
            Self::Parallel { .. } | Self::Unknown => SmallVec::new(),
        }
    }

    /// Conditions of the step itself, in document order.
    pub(crate) fn conditions(&self) -> impl Iterator<Item = &Condition> {
        let (one, whens): (_, &[When]) = match self {
            Self::If { condition, .. } | Self::Wait { condition, .. } => (Some(condition), &[]),
            Self::Repeat { until, .. } => (until.as_ref().map(|(until, _)| until), &[]),
            Self::Monitor { whens, .. } => (None, whens),
            Self::Call(_)
            | Self::Let { .. }
            | Self::Sequence { .. }
            | Self::Inline { .. }
            | Self::Try { .. }
            | Self::Delay { .. }
            | Self::Finally { .. }
            | Self::Each { .. }
            | Self::Parallel { .. }
            | Self::End { .. }
            | Self::Unknown => (None, &[]),
        };
        one.into_iter().chain(whens.iter().map(|when| &when.condition))
    }
}

/// A call of a primitive with its arguments.
#[derive(Clone, Debug)]
pub(crate) struct Call {
    pub(crate) primitive: Primitive,
    /// One argument for each parameter.
    pub(crate) args: SmallVec<[Term; 2]>,
    /// Span of each argument; for a default, of the call.
    pub(crate) spans: SmallVec<[Span; 2]>,
    /// Unit of each argument as written, if it is a quantity.
    pub(crate) units: SmallVec<[Option<Unit>; 4]>,
    pub(crate) binds: Option<BindingId>,
    /// Manner of its motion, if one is written.
    pub(crate) manner: Option<Manner>,
    /// Deadline in seconds, if one is written.
    pub(crate) within_secs: Option<f64>,
    /// Number of further attempts after a failure.
    pub(crate) retries: u32,
    /// True if an argument has an error: what the call needs and changes is not known.
    pub(crate) is_faulty: bool,
}

impl Call {
    /// Deadline in seconds: the one written, or else the longest time of the primitive in this manner.
    pub(crate) fn deadline_secs(&self, takes: (f64, f64)) -> f64 {
        self.within_secs.unwrap_or_else(|| takes.1 * self.manner.map_or(1.0, Manner::stretch))
    }

    /// The first literal text among the arguments: the description, if the call is a perception.
    pub(crate) fn text(&self) -> Option<&SmolStr> {
        self.args.iter().find_map(|arg| if let Term::Text(text) = arg { Some(text) } else { None })
    }
}

/// A watched condition of a monitor.
#[derive(Clone, Debug)]
pub(crate) struct When {
    pub(crate) condition: Condition,
    pub(crate) span: Span,
    /// Time in seconds for which the condition must hold.
    pub(crate) hold_secs: f64,
    pub(crate) reaction: Reaction,
}

/// Reaction of a monitor that fires.
#[derive(Clone, Debug)]
pub(crate) enum Reaction {
    /// Pauses the body.
    Pause {
        /// Maximal duration of the pause in seconds.
        within_secs: f64,
    },
    /// Fails with `timeout`: the body of a `within` has had its time.
    Timeout,
    /// Restarts the body.
    Restart { at_most: u32 },
    /// Runs a block, then resumes the body.
    Resume { at_most: u32, body: Block },
    /// Ends the policy or the inlined policy `of`.
    End { kind: EndKind, of: Option<StepId>, why: Option<Term> },
}

impl Reaction {
    /// Returns whether the body goes on behind the reaction.
    pub(crate) fn goes_on(&self) -> bool {
        matches!(self, Self::Pause { .. } | Self::Resume { .. })
    }
}

/// A handler of failures.
#[derive(Clone, Debug)]
pub(crate) struct Catch {
    /// Failures with their spans; `None` for `any`.
    pub(crate) on: Option<Vec<(Failure, Span)>>,
    /// Span of the failures, or of the whole handler.
    pub(crate) span: Span,
    /// Bindings of the failure, if the handler names it.
    pub(crate) binds: Option<CaughtFailure>,
    pub(crate) body: Block,
}

/// Bindings of a failure that a handler names.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CaughtFailure {
    pub(crate) kind: BindingId,
    pub(crate) text: BindingId,
}
