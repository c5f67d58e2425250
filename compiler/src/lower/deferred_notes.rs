//! Needs and motions that are left to the run, each with the step before which the engine checks it.

use motet_syntax::Diagnostic;
use smol_str::SmolStr;

use super::is_of_motion;
use crate::declare::{Library, PrimitiveDef};
use crate::environment::Environment;
use crate::feasibility::{MotionVerdict, MotionVerdicts};
use crate::ir::{BlockSlot, Call, Program, StepId, StepKind, Term};
use crate::prove::diagnostics::DeferredToRun;
use crate::prove::evaluation::CallFrame;
use crate::prove::{NeedVerdict, Proof, Prover};

/// Verdict on a need of a call as the graph carries it: what is derived from a motion is proven with it.
pub(super) fn need_verdict(
    proof: &Proof,
    placed: Option<&MotionVerdict>,
    (step, index): (StepId, usize),
    def: &PrimitiveDef,
    library: &Library,
) -> Option<NeedVerdict> {
    let verdict = *proof.needs.get(step.index())?.get(index)?;
    let need = def.needs.get(index)?;
    let of_motion = placed.filter(|_| is_of_motion(need, def, library));
    Some(match of_motion {
        Some(MotionVerdict::Feasible(..)) => NeedVerdict::Proven,
        Some(MotionVerdict::Caught(_)) => NeedVerdict::Caught,
        Some(MotionVerdict::Deferred(_)) | None => verdict,
    })
}

/// Notes on the steps of a program that have guards, in the order of the steps. Motions count only if there
/// was a geometry that could have decided them.
pub(crate) fn deferred_notes(
    program: &Program,
    proof: &Proof,
    placed: &MotionVerdicts,
    library: &Library,
    environment: &Environment,
) -> Vec<Diagnostic> {
    let prover = Prover::new(program, library, environment);
    let mut notes = Vec::new();
    for (index, step) in program.steps.iter().enumerate() {
        let (StepKind::Call(call), Ok(id)) = (&step.kind, u32::try_from(index)) else { continue };
        let Some(def) = library.primitive(call.primitive) else { continue };
        let verdict = placed.get(index).and_then(Option::as_ref);
        if matches!(verdict, Some(MotionVerdict::Caught(_))) {
            continue;
        }
        let mut left = needs_left(&prover, proof, verdict, StepId(id), (call, def));
        if let (Some(MotionVerdict::Deferred(_)), Some((kind, args))) = (verdict, &def.motion) {
            let frame = CallFrame { args: &call.args, ..CallFrame::default() };
            let is_asked = |(index, arg): &(usize, &Term)| {
                // A rule with its default asks for nothing.
                let Term::Param(param) = arg else { return true };
                let param = usize::from(*param);
                let default = def.params.get(param).and_then(|it| it.default_after(|at| call.args.get(at)));
                *index < kind.arity() || default != call.args.get(param)
            };
            let args = args.iter().enumerate().filter(is_asked);
            let args = args.map(|(_, arg)| prover.term_text(arg, frame).to_string());
            left.push(format!("the motion `{}({})`", kind.name(), args.collect::<Vec<_>>().join(", ")));
        }
        let Some((last, rest)) = left.split_last() else { continue };
        let what = if rest.is_empty() { last.clone() } else { format!("{} and {last}", rest.join(", ")) };
        let number = number(program, StepId(id));
        notes.push(DeferredToRun { span: step.span, callee: def.name.clone(), what, step: number }.into());
    }
    notes
}

/// The guards of a call, in words.
pub(super) fn needs_left(
    prover: &Prover<'_>,
    proof: &Proof,
    placed: Option<&MotionVerdict>,
    id: StepId,
    (call, def): (&Call, &PrimitiveDef),
) -> Vec<String> {
    let result = call.binds.and_then(|binding| prover.symbols.of_binding(binding.index()));
    let guards = def.needs.iter().enumerate().filter_map(|(index, need)| {
        let verdict = need_verdict(proof, placed, (id, index), def, prover.library)?;
        (verdict == NeedVerdict::Deferred).then_some((index, need))
    });
    let texts = guards.map(|(index, need)| {
        let each = proof.unknown_of.get(&(id, index)).copied();
        let frame = CallFrame { args: &call.args, result, each };
        let mut text = prover.show(&need.condition, true, frame);
        if let (Some(kind), None) = (need.each, each) {
            let kind = prover.library.kinds.get(kind.index()).map_or("?", |def| def.name.as_str());
            text.push_str(&format!(" for each `{kind}`"));
        }
        if proof.retried.contains(&(id, index)) {
            text.push_str(" in a retry");
        }
        text
    });
    texts.collect()
}

/// Number of a step in its document, from 1: `3`, or `2.then.1`. A step of a called policy has the number of
/// the call.
fn number(program: &Program, id: StepId) -> String {
    let file = program.span.file;
    let chain = std::iter::once(id).chain(program.around(id).map(|(id, _)| id));
    let own = chain.filter_map(|id| program.step(id)).filter(|step| step.span.file == file);
    let parts = own.filter_map(|step| {
        let number = step.position.index + 1;
        let part = match step.position.slot {
            BlockSlot::Steps | BlockSlot::Timed | BlockSlot::Kept | BlockSlot::Inlined => number.to_string(),
            BlockSlot::Then => format!("then.{number}"),
            BlockSlot::Else => format!("else.{number}"),
            BlockSlot::Try => format!("try.{number}"),
            BlockSlot::Catch(index) => format!("catch.{}.{number}", index + 1),
            BlockSlot::During => format!("during.{number}"),
            BlockSlot::Reaction(index) => format!("monitor.{}.{number}", index + 1),
            BlockSlot::Branch(index) => format!("parallel.{}.{number}", index + 1),
            BlockSlot::Finally => format!("finally.{number}"),
            // It has no place of its own.
            BlockSlot::Protected | BlockSlot::KeptWhole | BlockSlot::InlinedWhole => return None,
        };
        Some(part)
    });
    let mut parts: Vec<SmolStr> = parts.map(SmolStr::from).collect();
    parts.reverse();
    parts.join(".")
}
