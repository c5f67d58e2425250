//! SayCan from the text alone: an instruction is understood and planned for by the planner that needs no
//! model, and the policy is run in simulation. The row's own plan and goal are only looked at to judge the
//! end.

use motet_planner::builtin;
use motet_requests::RequestContext;
use motet_syntax::Sources;
use serde::Serialize;

use super::row::Row;
use crate::setup;

/// Result of an instruction.
#[derive(Clone, Debug)]
pub struct Try {
    /// The row's name.
    pub id: String,
    /// The kind of instruction.
    pub family: String,
    /// Instruction of the person.
    pub instruction: String,
    /// True if there was a policy that passed the check.
    pub is_planned: bool,
    /// True if the policy ran to its end.
    pub is_run: bool,
    /// True if the goal of the row then held.
    pub is_reached: bool,
    /// Description of the difference.
    pub note: Option<String>,
}

/// The sums of one family, as rates.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Sums {
    /// Instructions.
    pub total: usize,
    /// Those with a policy whose end is the goal that the row asks for. A policy for something else is no
    /// plan.
    pub plan: usize,
    /// Those after whose run the goal held.
    pub execution: usize,
    /// Those that were planned for something else than was asked: guesses.
    pub wrong: usize,
    /// Those that were not understood, and said so.
    pub declined: usize,
}

/// Plans and runs a row.
///
/// # Errors
///
/// Where the line is no such row.
pub fn attempt(line: &str) -> Result<Try, String> {
    let row = Row::read(line).map_err(|error| error.to_string())?;
    let mut result = Try {
        id: row.id.clone(),
        family: row.family.clone(),
        instruction: row.instruction.clone(),
        is_planned: false,
        is_run: false,
        is_reached: false,
        note: None,
    };
    if let Err(why) = run(&row, &mut result) {
        result.note = Some(why);
    }
    Ok(result)
}

fn run(row: &Row, result: &mut Try) -> Result<(), String> {
    let robot = setup::robot("hsr");
    let scene = setup::scene_from(&row.id, &row.scene());
    let mut sources = Sources::default();
    let (session, said) = setup::session(Some(&robot), Some(&scene), &mut sources);
    if let Some(wrong) = said.first() {
        return Err(format!("{} {}", wrong.code, wrong.message));
    }
    let situation = RequestContext::new(&scene);
    let answered = builtin::answer(&session, Some(&robot), &row.instruction, &situation);
    let answered = answered.map_err(|why| why.to_string())?;
    result.is_planned = true;
    let graph = answered.planned.compiled.graph.ok_or("no graph")?;
    let sim = super::simulate(graph, &robot, &scene)?;
    result.is_run = true;
    result.is_reached = row.reached(|fluent, args| sim.holds(fluent, args) == Some(true));
    if result.is_reached { Ok(()) } else { Err(format!("another goal:\n{}", answered.planned.text)) }
}

/// Sums over tries.
#[must_use]
pub fn sums<'t>(tries: impl Iterator<Item = &'t Try>) -> Sums {
    tries.fold(Sums::default(), |sums, one| Sums {
        total: sums.total + 1,
        // Where the run ended elsewhere the plan was for something else; where it failed on the way it was
        // a plan.
        plan: sums.plan + usize::from(one.is_planned && (one.is_reached || !one.is_run)),
        execution: sums.execution + usize::from(one.is_reached),
        wrong: sums.wrong + usize::from(one.is_run && !one.is_reached),
        declined: sums.declined + usize::from(!one.is_planned),
    })
}

/// The table of plan and execution rates by family, in the layout of SayCan's.
#[must_use]
pub fn table(tries: &[Try]) -> Vec<String> {
    let mut families: Vec<&str> = Vec::new();
    for one in tries {
        if !families.contains(&one.family.as_str()) {
            families.push(&one.family);
        }
    }
    let mut lines = vec![format!(
        "{:<24} {:>4} {:>6} {:>10} {:>6} {:>9}",
        "family", "n", "plan", "execution", "wrong", "declined"
    )];
    let percent = |part: usize, of: usize| format!("{:.0} %", 100.0 * part as f64 / of.max(1) as f64);
    let row = |name: &str, sums: &Sums| {
        let (plan, execution) = (percent(sums.plan, sums.total), percent(sums.execution, sums.total));
        format!(
            "{name:<24} {:>4} {plan:>6} {execution:>10} {:>6} {:>9}",
            sums.total, sums.wrong, sums.declined
        )
    };
    for family in families {
        lines.push(row(family, &sums(tries.iter().filter(|one| one.family == family))));
    }
    lines.push(row("total", &sums(tries.iter())));
    lines
}
