//! Rows as trainers read them: a JSON object a line.
//!
//! | form | a row | who reads it |
//! |---|---|---|
//! | [`Form::Trl`] | `messages` with `role` and `content` | TRL's `SFTTrainer`, as conversational language modelling |
//! | [`Form::LlamaFactory`] | `conversations` with `from` and `value`, and `system` | LLaMA-Factory, as `sharegpt` |
//! | [`Form::QwenVl`] | `conversations` alone: that trainer knows no system part | the trainer of Qwen2.5-VL |
//! | [`Form::InteLiPlan`] | `text` with InteLiPlan's tags and a list of actions | TRL's `SFTTrainer`, as plain text |
//!
//! Beside that each row has `motet`, an object of texts, which trainers pass over and [`crate::lint`]
//! needs: the robot, the
//! room, the task, what goes wrong, and the turn.

mod read;
mod write;

pub use read::{Read, Target, read};
pub use write::{dataset_info, write};

/// A form of rows.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Form {
    /// As TRL reads them.
    Trl,
    /// As LLaMA-Factory reads them.
    LlamaFactory,
    /// As the trainer of Qwen2.5-VL reads them.
    QwenVl,
    /// In InteLiPlan's dialect.
    InteLiPlan,
}
