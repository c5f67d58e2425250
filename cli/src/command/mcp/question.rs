//! Client that answers the questions of a policy.

use std::sync::Arc;

use motet_graph::Value;
use motet_runtime::Outcome;
use motet_stdlib::lang::failures;
use smol_str::SmolStr;

use super::run_table::RunTable;
use crate::questions::{Answerer, Question};

/// Client of the run table, which answers the questions of a run.
pub(super) struct Client {
    runs: Arc<RunTable>,
    run: String,
}

impl Client {
    pub(super) fn new(runs: &Arc<RunTable>, run: &str) -> Self {
        Self { runs: Arc::clone(runs), run: run.to_owned() }
    }
}

impl Answerer for Client {
    fn ask(&mut self, question: &Question) {
        let options = question.options.iter().flatten().map(ToString::to_string);
        self.runs.ask(&self.run, &question.text, &options.collect::<Vec<_>>());
    }

    fn outcome(&mut self, question: &Question) -> Option<Outcome> {
        Some(match self.runs.take_answer(&self.run)? {
            None => Outcome::Failure(SmolStr::new_static(failures::REFUSED).into()),
            Some(id) if question.options.is_some() => Outcome::Success(Some(Value::Entity(id.into()))),
            Some(text) => Outcome::Success(Some(Value::Text(text.into()))),
        })
    }

    fn withdraw(&mut self) {
        self.runs.withdraw(&self.run);
    }
}
