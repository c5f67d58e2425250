//! `motet decode`: the continuations of a policy prefix, as words, bytes or tokens.

mod continuations;

use std::path::{Path, PathBuf};

use clap::Args;
use motet_compiler::Session;
use motet_decode::{Acceptor, AcceptorFactory, Modifiers, Subset};
use motet_project::files::{Bytes, read_small};
use motet_syntax::ast::MAX_BYTES;
use motet_syntax::{Sources, Syntax, render};

use crate::documents::read_stdin;
use crate::error::{CliError, Exit};
use crate::flags::{DiagnosticFormat, EnvironmentArgs, SyntaxArg};
use crate::output::Colors;
use crate::report::Report;
use continuations::{describe_tokens, next_words, quoted, read_vocabulary, refused};

/// Flags of `motet decode`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    printf '{\"motet\":1,' | motet decode - --robot hsr --scene kitchen\n  \
    motet decode prefix.json --robot hsr --scene kitchen --explain\n  \
    motet decode prefix.json --robot hsr --scene kitchen --tokenizer tokenizer.json\n\n\
    The prefix is written in the canonical subset, without white space; a final line break is ignored.\n\
    Exit codes: 0 some policy starts with the prefix, 1 none does, 2 the command could not run.")]
pub(crate) struct DecodeArgs {
    /// File with the policy prefix (`-` for stdin)
    #[arg(value_name = "FILE", default_value = "-")]
    path: PathBuf,
    #[command(flatten)]
    environment: EnvironmentArgs,
    /// Describe the possible words, and why other words are refused
    #[arg(long)]
    explain: bool,
    /// Show the possible tokens of a vocabulary: a file (tokenizer.json, a JSON list, or base64 lines), or
    /// `cl100k` or `o200k` if motet was built with the feature `tiktoken`
    #[arg(long, value_name = "NAME|FILE")]
    tokenizer: Option<String>,
    /// Token that ends a sequence, by name or number; required if the file does not define it
    #[arg(long, value_name = "TOKEN", requires = "tokenizer")]
    end: Option<String>,
    /// Syntax of the prefix
    #[arg(long, alias = "surface", value_enum, default_value = "json", value_name = "SYNTAX")]
    syntax: SyntaxArg,
    /// Allow manners, deadlines and retries
    #[arg(long)]
    modifiers: bool,
    /// Maximum size of the whole policy, in bytes
    #[arg(long, default_value_t = 20_000, value_name = "BYTES")]
    budget: usize,
}

/// Runs the command.
pub(crate) fn run(args: &DecodeArgs, colors: Colors) -> Result<Exit, CliError> {
    Report::run_held(DiagnosticFormat::Human, colors, |report| decode(args, report))
}

fn decode(args: &DecodeArgs, report: &mut Report) -> Result<Exit, CliError> {
    let mut project = args.environment.without_motions_in(Path::new("."))?.open_with(report)?;
    let session = project.session(report)?.session.clone();
    let mut prefix = read(&args.path)?;
    let syntax = args.syntax.into();
    let modifiers = if args.modifiers { Modifiers::Written } else { Modifiers::Default };
    let prepared = AcceptorFactory::new(&session, Subset { syntax, modifiers, ..Subset::default() });
    let mut acceptor = prepared
        .acceptor(args.budget)
        .ok_or_else(|| CliError::Message(format!("no policy fits into {} bytes", args.budget)))?;
    // Editors and shells end a file with a line break; any other white space belongs to the prefix.
    if prefix.last() == Some(&b'\n') {
        prefix.pop();
        prefix.pop_if(|last| *last == b'\r');
    }
    let taken = acceptor.accept(&prefix);
    let rest = prefix.split_off(taken);
    if !rest.is_empty() {
        report.out.text(&refusal(&mut acceptor, (&session, syntax), &rest));
        return Ok(Exit::Findings);
    }
    let tokens = args.tokenizer.as_ref().map(|name| {
        let vocabulary = read_vocabulary(name, args.end.as_deref())?;
        describe_tokens(&prepared, &vocabulary, &prefix, args.budget)
    });
    report.out.text(&continuations(&mut acceptor, (&session, syntax), args.explain));
    report.out.text(&tokens.transpose()?.unwrap_or_default());
    Ok(Exit::Success)
}

/// Describes the continuations.
fn continuations(acceptor: &mut Acceptor, (session, syntax): (&Session, Syntax), explain: bool) -> String {
    let mut text = format!("accepted: {}\n", crate::output::count(acceptor.bytes().len(), "byte"));
    let forced = acceptor.forced();
    if !forced.is_empty() {
        text.push_str(&format!("must follow: {}\n", quoted(&forced)));
        acceptor.accept(&forced);
    }
    if acceptor.is_accepting() {
        text.push_str("the policy is complete: only the end may follow\n");
    } else if explain {
        let next = next_words(acceptor, syntax);
        text.push_str(&next.describe(&session.signatures(), acceptor));
        // The text syntax has no list of the words that names and types alone would allow.
        if syntax == Syntax::Json {
            text.push_str(&refused(acceptor, &session.signatures(), &next));
        }
    } else {
        text.push_str(&format!("may follow: {}\n", quoted(&acceptor.next_bytes())));
    }
    text
}

/// Describes the place where the prefix is refused, and the reason.
fn refusal(acceptor: &mut Acceptor, (session, syntax): (&Session, Syntax), rest: &[u8]) -> String {
    let before = acceptor.bytes();
    let line = before.iter().filter(|byte| **byte == b'\n').count() + 1;
    let from = before.len().saturating_sub(40);
    let tail = before.get(from..).unwrap_or_default();
    let gap = if from > 0 { "…" } else { "" };
    let mut text = format!(
        "refused: {} at byte {} (line {line}, column {}), after {gap}{}\n",
        quoted(rest.get(..1).unwrap_or_default()),
        before.len(),
        before.len() + 1,
        quoted(tail),
    );
    let why = acceptor.why_not(rest);
    if why.is_empty() {
        text.push_str(
            "why: only the spelling; the canonical subset has one for each policy (docs/decoding.md)\n",
        );
    } else {
        for line in render::llm(&why, &Sources::default()).lines() {
            text.push_str(&format!("why: {line}\n"));
        }
    }
    let next = next_words(acceptor, syntax);
    text.push_str(&next.describe(&session.signatures(), acceptor));
    text
}

fn read(path: &Path) -> Result<Vec<u8>, CliError> {
    if path.as_os_str() != "-" {
        return Ok(read_small(path)?);
    }
    match read_stdin()? {
        Bytes::All(bytes) => Ok(bytes),
        Bytes::TooMany(_) => Err(CliError::Message(format!("stdin is larger than {} MiB", MAX_BYTES >> 20))),
    }
}
