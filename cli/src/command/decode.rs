//! `motet decode`: what may follow in a policy that has been begun, in words, as bytes or as tokens.

mod next;
mod place;
mod refused;
mod tokens;

use std::io;
use std::path::Path;

use motet_compiler::Session;
use motet_decode::{Acceptor, AcceptorFactory, Modifiers, Subset};
use motet_syntax::ast::{File, MAX_BYTES};
use motet_syntax::{Sources, Syntax, render};

use crate::args::{DecodeArgs, DecodeForm, Format, WorldArgs};
use crate::exit::{Exit, Trouble};
use crate::input::{Bytes, read_small, read_stdin};
use crate::out::Colors;
use crate::report::Report;
use crate::workbench::Workbench;

/// Runs the command.
///
/// # Errors
///
/// The beginning, the robot, the scene, the state, a domain or the tokenizer cannot be read.
pub(crate) fn run(args: &DecodeArgs, colors: Colors) -> Result<Exit, Trouble> {
    let mut report = Report::new(Format::Human, colors);
    report.hold();
    let result = decode(args, &mut report);
    report.close(result)
}

fn decode(args: &DecodeArgs, report: &mut Report) -> Result<Exit, Trouble> {
    let world = WorldArgs::from(args.known.clone());
    let mut bench = Workbench::open(&world, report)?;
    let session = bench.setting(&File::default(), report)?.session.clone();
    let mut begun = read(&args.path)?;
    let form = match args.surface {
        DecodeForm::Json => Syntax::Json,
        DecodeForm::Text => Syntax::Text,
    };
    let modifiers = if args.modifiers { Modifiers::Written } else { Modifiers::Default };
    let prepared = AcceptorFactory::new(&session, Subset { syntax: form, modifiers, ..Subset::default() });
    let mut acceptor = prepared
        .acceptor(args.budget)
        .ok_or_else(|| Trouble::Other(format!("no policy has at most {} bytes", args.budget)))?;
    // What editors and shells put at the end of a file; any other space belongs to the beginning.
    if begun.last() == Some(&b'\n') {
        begun.pop();
        begun.pop_if(|last| *last == b'\r');
    }
    let taken = acceptor.accept(&begun);
    let rest = begun.split_off(taken);
    if !rest.is_empty() {
        report.out.text(&refusal(&mut acceptor, (&session, form), &rest));
        return Ok(Exit::Findings);
    }
    let tokens = args.tokenizer.as_ref().map(|name| {
        let vocabulary = tokens::vocabulary(name, args.end.as_deref())?;
        tokens::told(&prepared, &vocabulary, &begun, args.budget)
    });
    report.out.text(&told(&mut acceptor, (&session, form), args.explain));
    report.out.text(&tokens.transpose()?.unwrap_or_default());
    Ok(Exit::Clean)
}

/// What may follow.
fn told(acceptor: &mut Acceptor, (session, form): (&Session, Syntax), explain: bool) -> String {
    let mut text = format!("taken: {}\n", crate::out::count(acceptor.bytes().len(), "byte"));
    let forced = acceptor.forced();
    if !forced.is_empty() {
        text.push_str(&format!("must follow: {}\n", quoted(&forced)));
        acceptor.accept(&forced);
    }
    if acceptor.is_accepting() {
        text.push_str("the policy is whole: nothing may follow but the end\n");
    } else if explain {
        let next = next::next(acceptor, form);
        text.push_str(&next.told(&session.signatures(), acceptor));
        // Which words of the text form names and types alone would allow is not told.
        if form == Syntax::Json {
            text.push_str(&refused::refused(acceptor, &session.signatures(), &next));
        }
    } else {
        text.push_str(&format!("may follow: {}\n", quoted(&acceptor.next_bytes())));
    }
    text
}

/// Where what was begun is refused, and why.
fn refusal(acceptor: &mut Acceptor, (session, form): (&Session, Syntax), rest: &[u8]) -> String {
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
            "why: only the spelling; the model surface has one for each policy (docs/decoding.md)\n",
        );
    } else {
        for line in render::llm(&why, &Sources::default()).lines() {
            text.push_str(&format!("why: {line}\n"));
        }
    }
    let next = next::next(acceptor, form);
    text.push_str(&next.told(&session.signatures(), acceptor));
    text
}

/// Bytes between quotes, escaped as in JSON.
pub(super) fn quoted(bytes: &[u8]) -> String {
    serde_json::Value::from(String::from_utf8_lossy(bytes)).to_string()
}

fn read(path: &Path) -> Result<Vec<u8>, Trouble> {
    if path.as_os_str() != "-" {
        return read_small(path);
    }
    match read_stdin() {
        Ok(Bytes::All(bytes)) => Ok(bytes),
        Ok(Bytes::TooMany(_)) => {
            Err(Trouble::Other(format!("standard input is larger than {} MiB", MAX_BYTES >> 20)))
        }
        Err(source) => Err(unread(path, source)),
    }
}

fn unread(path: &Path, source: io::Error) -> Trouble {
    Trouble::Read { path: path.to_owned(), source }
}
