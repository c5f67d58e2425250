//! Checks of the documentation: every page is in the book, every link and every path of the repository leads
//! somewhere, and every command runs.
//!
//! A fenced block acts by its language:
//! - `sh` runs as one script and must exit with 0;
//! - `console` holds commands after `$ ` and what each prints. A line `…` stands for any lines, `…` in a
//!   line for any text.
//!   A command that must fail ends with `# exits with N`;
//! - `motet` must be in canonical form, `json` and `toml` well formed, and each line of `jsonl` too;
//! - any other block is text.
//!
//! A block becomes the file that a comment before it names: `<!-- file: my_robot/robot.toml -->`.
//! `<!-- not run: REASON -->` before a block keeps it from running, and `<!-- if: COMMAND -->` where the
//! command fails, such as one that looks for a package. All blocks of a page share a folder, which begins
//! with a copy of `examples/` and a link to `python/`.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Time limit of a script, in seconds.
const SECONDS: &str = "120";

/// A fenced block of a page.
struct Block {
    line: usize,
    language: String,
    text: String,
    directive: Option<Directive>,
}

/// A comment before a block.
enum Directive {
    File(String),
    NotRun(String),
    /// Command without whose success the block does not run.
    If(String),
}

/// Checks all pages with the `motet` command at `motet`. `only` names one page. Returns whether nothing was
/// found.
///
/// # Errors
///
/// A message where a page or a folder cannot be read or written.
pub(crate) fn run(root: &Path, motet: &Path, only: Option<&str>) -> Result<bool, String> {
    let motet = motet.canonicalize().map_err(|error| format!("{}: {error}", motet.display()))?;
    let pages = pages(root)?;
    let mut problems = unlisted(root, &pages)?;
    for page in pages.iter().map(String::as_str).chain(["ARCHITECTURE.md", "CONTRIBUTING.md"]) {
        let text = read(&root.join(page))?;
        problems.extend(broken_links(root, page, &text));
        problems.extend(broken_paths(root, page, &text));
    }
    for page in pages.iter().filter(|page| only.is_none_or(|only| page.as_str() == only)) {
        let text = read(&root.join(page))?;
        let (ran, skipped, failed) = run_blocks(root, page, &text, &motet)?;
        println!("{page}: {ran} blocks ran, {skipped} did not, {} failed", failed.len());
        problems.extend(failed);
    }
    problems.iter().for_each(|problem| eprintln!("{problem}"));
    Ok(problems.is_empty())
}

/// The README and the pages of the book, as paths from the root.
fn pages(root: &Path) -> Result<Vec<String>, String> {
    let mut pages = vec!["README.md".to_owned()];
    let summary = read(&root.join("docs/SUMMARY.md"))?;
    pages.extend(links(&summary).into_iter().map(|(_, target)| format!("docs/{target}")));
    Ok(pages)
}

/// Pages below `docs/` that the book's summary does not list.
fn unlisted(root: &Path, pages: &[String]) -> Result<Vec<String>, String> {
    let entries = std::fs::read_dir(root.join("docs")).map_err(|error| error.to_string())?;
    let names = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    let pages: BTreeSet<&str> = pages.iter().map(String::as_str).collect();
    Ok(names
        .filter(|name| name.ends_with(".md") && name != "SUMMARY.md")
        .map(|name| format!("docs/{name}"))
        .filter(|page| !pages.contains(page.as_str()))
        .map(|page| format!("{page}: not in docs/SUMMARY.md"))
        .collect())
}

/// Relative links of a page that lead to no file, or to no heading of it.
fn broken_links(root: &Path, page: &str, text: &str) -> Vec<String> {
    let folder = Path::new(page).parent().unwrap_or(Path::new(""));
    let mut broken = Vec::new();
    for (line, target) in links(text) {
        if target.contains("://") || target.starts_with("mailto:") {
            continue;
        }
        let (file, anchor) = target.split_once('#').unwrap_or((target.as_str(), ""));
        let path = if file.is_empty() { root.join(page) } else { root.join(folder).join(file) };
        if !path.exists() {
            broken.push(format!("{page}:{line}: no file `{file}`"));
        } else if !anchor.is_empty()
            && !anchors(&std::fs::read_to_string(&path).unwrap_or_default()).contains(anchor)
        {
            broken.push(format!("{page}:{line}: no heading `#{anchor}` in `{file}`"));
        }
    }
    broken
}

/// Paths in backticks that begin with a folder of the repository and lead to nothing. A segment in capitals
/// stands for any name; of a path with `*` only the folders before it are looked up.
fn broken_paths(root: &Path, page: &str, text: &str) -> Vec<String> {
    let is_path = |token: &str| {
        let top = token.split_once('/').map_or("", |(top, _)| top);
        !["", "target"].contains(&top)
            && root.join(top).is_dir()
            && token.chars().all(|c| c.is_ascii_alphanumeric() || "/._-*".contains(c))
    };
    let is_fixed = |segment: &&str| {
        !segment.contains('*') && !segment.chars().all(|c| c.is_ascii_uppercase() || c == '_')
    };
    let mut broken = Vec::new();
    for (number, line) in text.lines().enumerate() {
        // Every other part stands between backticks.
        for token in line.split('`').skip(1).step_by(2).filter(|token| is_path(token)) {
            let path: Vec<&str> = token.split('/').filter(|part| !part.is_empty()).collect();
            let known: Vec<&str> = path.into_iter().take_while(is_fixed).collect();
            if !root.join(known.join("/")).exists() {
                broken.push(format!("{page}:{}: no path `{token}`", number + 1));
            }
        }
    }
    broken
}

/// The targets of `[text](target)` outside of code, with their lines.
fn links(text: &str) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    let mut in_fence = false;
    for (number, line) in text.lines().enumerate() {
        if line.trim_start().starts_with("```") {
            in_fence = !in_fence;
        }
        if in_fence {
            continue;
        }
        for (at, _) in line.match_indices("](") {
            let rest = line.get(at + 2..).unwrap_or("");
            if let Some((target, _)) = rest.split_once(')') {
                found.push((number + 1, target.to_owned()));
            }
        }
    }
    found
}

/// The anchors of a page's headings, as GitHub and mdBook make them.
fn anchors(text: &str) -> BTreeSet<String> {
    let headings = text.lines().filter(|line| line.starts_with('#'));
    headings
        .map(|line| {
            let title = line.trim_start_matches('#').trim().to_lowercase();
            let kept = title.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
            kept.map(|c| if c == ' ' { '-' } else { c }).collect()
        })
        .collect()
}

/// The fenced blocks of a page.
fn blocks(text: &str) -> Vec<Block> {
    let mut found = Vec::new();
    let mut directive = None;
    let mut lines = text.lines().enumerate();
    while let Some((number, line)) = lines.next() {
        let trimmed = line.trim_start();
        if let Some(comment) = trimmed.strip_prefix("<!-- ").and_then(|rest| rest.strip_suffix(" -->")) {
            directive = match comment.split_once(": ") {
                Some(("file", name)) => Some(Directive::File(name.to_owned())),
                Some(("not run", reason)) => Some(Directive::NotRun(reason.to_owned())),
                Some(("if", command)) => Some(Directive::If(command.to_owned())),
                _ => None,
            };
        } else if let Some(language) = trimmed.strip_prefix("```") {
            let indent = line.len() - trimmed.len();
            let mut text = String::new();
            for (_, line) in lines.by_ref() {
                if line.trim_start().starts_with("```") {
                    break;
                }
                let _ = writeln!(text, "{}", line.get(indent..).unwrap_or(""));
            }
            let language = language.split([',', ' ']).next().unwrap_or("").to_owned();
            found.push(Block { line: number + 1, language, text, directive: directive.take() });
        } else if !trimmed.is_empty() {
            directive = None;
        }
    }
    found
}

/// Runs the blocks of a page in a folder of its own: how many ran, how many did not, and what failed.
fn run_blocks(
    root: &Path,
    page: &str,
    text: &str,
    motet: &Path,
) -> Result<(usize, usize, Vec<String>), String> {
    let folder = root.join("target/docs").join(page.replace('/', "-").trim_end_matches(".md"));
    let fail = |error: std::io::Error| format!("{}: {error}", folder.display());
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).map_err(fail)?;
    copy_folder(&root.join("examples"), &folder.join("examples"))?;
    // The examples look for the package of Python beside them.
    #[cfg(unix)]
    std::os::unix::fs::symlink(root.join("python"), folder.join("python"))
        .map_err(|error| format!("{}: {error}", folder.display()))?;
    let (mut ran, mut skipped, mut failed) = (0, 0, Vec::new());
    for block in blocks(text) {
        let place = format!("{page}:{}", block.line);
        let mut directive = &block.directive;
        if let Some(Directive::If(command)) = directive {
            if shell(command, &folder, motet)?.1 != 0 {
                println!("{place}: not run: `{command}` fails");
                skipped += 1;
                continue;
            }
            directive = &None;
        }
        match (directive, block.language.as_str()) {
            (Some(Directive::File(name)), _) => {
                let path = folder.join(name);
                std::fs::create_dir_all(path.parent().unwrap_or(&folder)).map_err(fail)?;
                std::fs::write(&path, &block.text).map_err(fail)?;
                failed.extend(malformed(&block, &folder, motet)?.map(|why| format!("{place}: {why}")));
            }
            (Some(Directive::NotRun(reason)), _) => {
                println!("{place}: not run: {reason}");
                skipped += 1;
            }
            (None, "sh") => {
                ran += 1;
                let (output, code) = shell(&block.text, &folder, motet)?;
                if code != 0 {
                    failed.push(format!("{place}: exits with {code}\n{output}"));
                }
            }
            (None, "console") => {
                ran += 1;
                for (command, expected) in commands(&block.text) {
                    let (command, wanted) = command.split_once("# exits with ").unwrap_or((&command, "0"));
                    let (output, code) = shell(command, &folder, motet)?;
                    if code.to_string() != wanted.trim() {
                        failed.push(format!("{place}: `{command}` exits with {code}\n{output}"));
                    } else if !matches(&expected, &output) {
                        failed.push(format!("{place}: `{command}` prints\n{output}"));
                    }
                }
            }
            (None | Some(Directive::If(_)), _) => {
                failed.extend(malformed(&block, &folder, motet)?.map(|why| format!("{place}: {why}")));
            }
        }
    }
    Ok((ran, skipped, failed))
}

/// The reason why a policy or a document is not well formed, if its language can be read.
fn malformed(block: &Block, folder: &Path, motet: &Path) -> Result<Option<String>, String> {
    let json =
        |text: &str| serde_json::from_str::<serde_json::Value>(text).err().map(|error| error.to_string());
    Ok(match block.language.as_str() {
        "motet" => {
            let path = folder.join(format!("line_{}.motet", block.line));
            std::fs::write(&path, &block.text).map_err(|error| format!("{}: {error}", path.display()))?;
            let (output, code) = shell(&format!("motet fmt --check '{}'", path.display()), folder, motet)?;
            (code != 0).then(|| format!("not in canonical form\n{output}"))
        }
        "json" => json(&block.text),
        "jsonl" => block.text.lines().find_map(json),
        "toml" => toml::from_str::<toml::Table>(&block.text).err().map(|error| error.to_string()),
        _ => None,
    })
}

/// The commands of a `console` block, each with its expected output.
fn commands(text: &str) -> Vec<(String, String)> {
    let mut found: Vec<(String, String)> = Vec::new();
    for line in text.lines() {
        if let Some(command) = line.strip_prefix("$ ") {
            found.push((command.to_owned(), String::new()));
        } else if let Some((command, output)) = found.last_mut() {
            if output.is_empty() && command.ends_with('\\') {
                let _ = write!(command, "\n{line}");
            } else {
                let _ = writeln!(output, "{line}");
            }
        }
    }
    found
}

/// Runs a script, and returns what it printed on both streams, and its exit code.
fn shell(script: &str, folder: &Path, motet: &Path) -> Result<(String, i32), String> {
    let path = std::env::var("PATH").unwrap_or_default();
    let tools = motet.parent().unwrap_or(Path::new("/"));
    let output = Command::new("timeout")
        .args([SECONDS, "bash", "-euo", "pipefail", "-c", &format!("exec 2>&1\n{script}")])
        .current_dir(folder)
        .env("PATH", format!("{}:{path}", tools.display()))
        .env("NO_COLOR", "1")
        .stdin(Stdio::null())
        .output()
        .map_err(|error| format!("bash: {error}"))?;
    Ok((String::from_utf8_lossy(&output.stdout).into_owned(), output.status.code().unwrap_or(-1)))
}

/// Whether `output` is what `expected` describes. Spaces at the ends of lines do not count.
fn matches(expected: &str, output: &str) -> bool {
    let expected: Vec<&str> = expected.trim_end().lines().map(str::trim_end).collect();
    let output: Vec<&str> = output.trim_end().lines().map(str::trim_end).collect();
    matches_lines(&expected, &output)
}

fn matches_lines(expected: &[&str], output: &[&str]) -> bool {
    match expected.split_first() {
        None => output.is_empty(),
        Some((&"…", rest)) => (0..=output.len())
            .any(|skipped| output.get(skipped..).is_some_and(|output| matches_lines(rest, output))),
        Some((line, rest)) => {
            let Some((first, others)) = output.split_first() else { return false };
            matches_line(line, first) && matches_lines(rest, others)
        }
    }
}

fn matches_line(expected: &str, line: &str) -> bool {
    let mut parts = expected.split('…');
    let Some(mut rest) = parts.next().and_then(|first| line.strip_prefix(first)) else { return false };
    let mut is_open = false;
    for part in parts {
        is_open = true;
        match rest.find(part) {
            Some(at) => rest = rest.get(at + part.len()..).unwrap_or(""),
            None => return false,
        }
    }
    rest.is_empty() || (is_open && expected.ends_with('…'))
}

fn copy_folder(from: &Path, to: &Path) -> Result<(), String> {
    let fail = |path: &PathBuf| {
        let path = path.display().to_string();
        move |error: std::io::Error| format!("{path}: {error}")
    };
    std::fs::create_dir_all(to).map_err(fail(&to.to_path_buf()))?;
    for entry in std::fs::read_dir(from).map_err(fail(&from.to_path_buf()))?.filter_map(Result::ok) {
        let (source, target) = (entry.path(), to.join(entry.file_name()));
        if source.is_dir() {
            copy_folder(&source, &target)?;
        } else {
            std::fs::copy(&source, &target).map_err(fail(&source))?;
        }
    }
    Ok(())
}

fn read(path: &Path) -> Result<String, String> {
    std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn matches_takes_dots_for_lines_and_text() {
        assert!(matches("a\n…\nz 1… s", "a\nb\nc\nz 1.5 s\n"));
        assert!(matches("a …", "a b c"));
        assert!(!matches("a\nb", "a\nc"));
        assert!(!matches("a", "a\nb"));
    }

    #[test]
    fn blocks_carry_the_directive_before_them() {
        let found = blocks("<!-- file: a.toml -->\n\n```toml\nx = 1\n```\ntext\n```sh\ntrue\n```\n");
        let seen: Vec<_> = found
            .iter()
            .map(|block| (block.line, block.language.as_str(), block.directive.is_some()))
            .collect();
        assert_eq!(seen, [(3, "toml", true), (7, "sh", false)]);
    }

    #[test]
    fn commands_keep_what_each_prints() {
        let found = commands("$ a\nx\n$ b\n");
        assert_eq!(found, [("a".to_owned(), "x\n".to_owned()), ("b".to_owned(), String::new())]);
    }

    #[test]
    fn broken_paths_looks_up_paths_of_the_repository() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        let found = broken_paths(
            &root,
            "a.md",
            "`xtask/src/docs.rs`, `xtask/no.rs`, `a/b`, `xtask/NAME/x`, `xtask/*.rs`",
        );
        assert_eq!(found, ["a.md:1: no path `xtask/no.rs`"]);
    }

    #[test]
    fn anchors_follow_headings() {
        assert!(anchors("## Drivers, in Rust\n").contains("drivers-in-rust"));
    }
}
