//! Text of a policy beside its run: the line of each step, and the findings of the check.

use std::collections::BTreeMap;

use motet_syntax::ast::{Block, File, Reaction, Step, StepKind};
use motet_syntax::{Diagnostic, FileId, Source, Sources, render};
use serde_json::{Value, json};

/// Text of a policy.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct PolicyText {
    /// Name of the file.
    pub name: String,
    pub text: String,
    /// Line of each step by its path, from 1.
    pub lines: BTreeMap<String, usize>,
    /// Findings of the check.
    pub findings: Vec<Value>,
}

impl PolicyText {
    /// Text of a policy in a parsed document.
    pub fn of(source: &Source, file: &File, policy: &str) -> Self {
        let (name, text) = (source.file().0.to_owned(), source.text.to_string());
        let mut lines = BTreeMap::new();
        if let Some(policy) = file.policies().find(|known| known.name.text == policy) {
            let mut open = vec![("/steps".to_owned(), &policy.body)];
            open.extend(policy.cleanup.as_ref().map(|cleanup| ("/finally".to_owned(), cleanup)));
            // Not recursive: a policy may nest deeply.
            while let Some((path, block)) = open.pop() {
                for (index, step) in block.steps.iter().enumerate() {
                    let path = format!("{path}/{index}");
                    lines.insert(path.clone(), source.line_column(step.span.start).0);
                    blocks(&path, step, &mut open);
                }
            }
        }
        Self { name, text, lines, findings: Vec::new() }
    }

    /// Text of a policy alone; without lines where it cannot be read.
    pub fn read(name: &str, text: &str) -> Self {
        let source = Source::new(name, text);
        let parsed = motet_syntax::read(&source, FileId(0));
        let policy = parsed.file.policies().next().map(|policy| policy.name.text.to_string());
        Self::of(&source, &parsed.file, policy.as_deref().unwrap_or_default())
    }

    /// The same with the findings of the check.
    pub fn with_findings(self, found: &[Diagnostic], sources: &Sources) -> Self {
        let finding = |found: &Diagnostic| serde_json::to_value(render::record(found, sources)).ok();
        Self { findings: found.iter().filter_map(finding).collect(), ..self }
    }

    /// Line of the step at a path. A step of an inlined policy has the line of its call.
    pub fn line(&self, path: &str) -> Option<usize> {
        let own = path.split(':').next().unwrap_or_default();
        self.lines.get(own).copied()
    }

    /// Text for the page.
    pub fn item(&self) -> Value {
        json!({"name": self.name, "text": self.text, "findings": self.findings})
    }
}

/// Adds the blocks of a step with the paths of their steps, as the graph names them.
fn blocks<'s>(path: &str, step: &'s Step, open: &mut Vec<(String, &'s Block)>) {
    let mut add = |slot: &str, block: &'s Block| open.push((format!("{path}{slot}"), block));
    match &step.kind {
        StepKind::Sequence { body, .. }
        | StepKind::Repeat { body, .. }
        | StepKind::Each { body, .. }
        | StepKind::Keep { body, .. }
        | StepKind::Within { body, .. } => add("/steps", body),
        StepKind::If { then, otherwise, .. } => {
            add("/then", then);
            otherwise.iter().for_each(|block| add("/else", block));
        }
        StepKind::Monitor { whens, body } => {
            add("/during", body);
            for (index, when) in whens.iter().enumerate() {
                if let Reaction::Resume { body, .. } = &when.reaction {
                    add(&format!("/monitor/{index}/then/steps"), body);
                }
            }
        }
        StepKind::Try { body, catches } => {
            add("/try", body);
            for (index, catch) in catches.iter().enumerate() {
                add(&format!("/catch/{index}/steps"), &catch.body);
            }
        }
        StepKind::Parallel { branches } => {
            for (index, branch) in branches.iter().enumerate() {
                add(&format!("/parallel/{index}"), branch);
            }
        }
        StepKind::Finally { step, cleanup } => {
            add("/finally", cleanup);
            blocks(path, step, open);
        }
        StepKind::Do(_)
        | StepKind::Let { .. }
        | StepKind::Wait { .. }
        | StepKind::Delay { .. }
        | StepKind::End(_) => {}
    }
}

#[cfg(test)]
mod tests {
    use super::PolicyText;

    #[test]
    fn policy_text_knows_the_lines_of_nested_steps() {
        let text = "policy p for hsr {\n  try {\n    say(\"a\")\n  } catch any {\n    say(\"b\")\n  }\n  \
                    sequence s {\n    say(\"c\")\n  } finally {\n    say(\"d\")\n  }\n}\n";
        let read = PolicyText::read("p.motet", text);
        let line = |path: &str| read.line(path);
        assert_eq!(line("/steps/0"), Some(2));
        assert_eq!(line("/steps/0/try/0"), Some(3));
        assert_eq!(line("/steps/0/catch/0/steps/0"), Some(5));
        assert_eq!(line("/steps/1/steps/0"), Some(8));
        assert_eq!(line("/steps/1/finally/0"), Some(10));
        assert_eq!(line("/steps/1:/steps/4"), Some(7));
        assert_eq!(line("/steps/9"), None);
    }
}
