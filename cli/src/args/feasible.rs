//! The flags of `motet feasible`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

/// `motet feasible`
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    motet feasible --robot hsr --scene kitchen --for 'reach(mug_1)'\n  \
    motet feasible --robot hsr --scene kitchen --for 'reach(coke, top)' --svg coke.svg\n  \
    motet feasible --robot hsr --scene kitchen --all --format json\n\
    A motion is go_to(ENTITY), reach(OBJECT), reach(OBJECT, top|side|front), put(OBJECT, ENTITY), offer(OBJECT, PERSON),\n\
    pull(CONTAINER), push(ENTITY), look(ENTITY) or posture(NAME). What the hand holds is said by the scene: \"robot\": {\"holding\": …}.\n\
    Exit codes: 0 every motion that was asked for is feasible, 1 one is not or is not known, 2 could not run.")]
pub(crate) struct FeasibleArgs {
    /// Robot: a built-in name (`motet robots`), or a folder with a robot.toml
    #[arg(long, value_name = "NAME|FOLDER")]
    pub(crate) robot: String,
    /// Scene: a built-in name, or a JSON file
    #[arg(long, value_name = "NAME|FILE")]
    pub(crate) scene: String,
    /// A motion to answer; may be repeated
    #[arg(long = "for", value_name = "MOTION", required_unless_present = "all")]
    pub(crate) motions: Vec<String>,
    /// Answer go_to for every entity, reach for every object, pull or push for every door, and every posture, each from the
    /// start; exits with 0
    #[arg(long, conflicts_with = "motions")]
    pub(crate) all: bool,
    /// How long each motion is looked for: 1 as usual, 4 for four times as many tries
    #[arg(long, value_name = "FACTOR", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=1000))]
    pub(crate) effort: u16,
    /// How to print the answers
    #[arg(long, value_enum, default_value_t, value_name = "FORMAT")]
    pub(crate) format: FeasibleFormat,
    /// Draw the room from above with the robot and the paths that were found
    #[arg(long, value_name = "FILE")]
    pub(crate) svg: Option<PathBuf>,
}

/// How answers are printed.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, ValueEnum)]
pub(crate) enum FeasibleFormat {
    /// A line each
    #[default]
    Human,
    /// A JSON object a line
    Json,
}
