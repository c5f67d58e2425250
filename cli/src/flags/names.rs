//! Names that a value may be beside a path, for the completions of shells.

use clap::builder::{PossibleValue, StringValueParser, TypedValueParser};
use clap::error::Error;
use motet_compiler::explain_pages;
use motet_robots::builtin;
use motet_sim::Profile;

/// Any text, of which some are names that a shell completes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct KnownNames(fn() -> Vec<&'static str>);

/// Built-in robots.
pub(crate) const ROBOTS: KnownNames = KnownNames(|| builtin::ROBOTS.iter().map(|robot| robot.name).collect());
/// Built-in scenes.
pub(crate) const SCENES: KnownNames = KnownNames(|| builtin::SCENES.iter().map(|scene| scene.name).collect());
/// Built-in profiles of the simulated world.
pub(crate) const PROFILES: KnownNames = KnownNames(|| Profile::names().collect());
/// Codes of diagnostics.
pub(crate) const CODES: KnownNames =
    KnownNames(|| explain_pages::PAGES.iter().map(|page| page.code).collect());

impl TypedValueParser for KnownNames {
    type Value = String;

    fn parse_ref(
        &self,
        command: &clap::Command,
        arg: Option<&clap::Arg>,
        value: &std::ffi::OsStr,
    ) -> Result<String, Error> {
        StringValueParser::new().parse_ref(command, arg, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new((self.0)().into_iter().map(PossibleValue::new)))
    }
}
