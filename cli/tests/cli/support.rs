//! Runs the built command as a user would, in a folder of its own.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::Duration;

/// Result of a run of the command.
#[derive(Debug)]
pub(crate) struct Ran {
    /// The exit code.
    pub(crate) code: Option<i32>,
    /// Text on standard output.
    pub(crate) stdout: String,
    /// Text on standard error.
    pub(crate) stderr: String,
}

/// Waits until something is so, half a minute at most, however slow the machine is; whether it is.
pub(crate) fn eventually(mut is_so: impl FnMut() -> bool) -> bool {
    (0..600).any(|_| {
        let is_so = is_so();
        if !is_so {
            std::thread::sleep(Duration::from_millis(50));
        }
        is_so
    })
}

/// A folder with files, and the command run in it.
pub(crate) struct Place {
    folder: PathBuf,
}

impl Place {
    /// An empty folder; the name is the test's.
    pub(crate) fn new(name: &str) -> Self {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        let _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).expect("the folder can be made");
        Self { folder }
    }

    /// Writes a file, with the folders above it.
    pub(crate) fn file(self, name: &str, content: impl AsRef<[u8]>) -> Self {
        let path = self.folder.join(name);
        std::fs::create_dir_all(path.parent().expect("a file is in a folder")).expect("folders can be made");
        std::fs::write(path, content).expect("the file can be written");
        self
    }

    /// Reads a file.
    pub(crate) fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.folder.join(name)).expect("the file is there")
    }

    /// Checks that a file exists and is not empty.
    pub(crate) fn says(&self, name: &str, word: &str) -> bool {
        std::fs::read_to_string(self.folder.join(name)).is_ok_and(|text| text.contains(word))
    }

    /// The path of a file in the folder.
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// Runs the command with a command line, split at blanks.
    pub(crate) fn run(&self, line: &str) -> Ran {
        self.run_with(line, b"", &[])
    }

    /// Runs a line of the shell in the folder.
    #[cfg(unix)]
    pub(crate) fn shell(&self, line: &str) -> Ran {
        let output =
            Command::new("sh").args(["-c", line]).current_dir(&self.folder).output().expect("a shell runs");
        Ran::of(output)
    }

    /// Runs the command with arguments, blanks and all.
    pub(crate) fn run_args(&self, args: &[String]) -> Ran {
        let output = Command::new(env!("CARGO_BIN_EXE_motet"))
            .args(args)
            .current_dir(&self.folder)
            .stdin(Stdio::null())
            .output()
            .expect("the command starts");
        Ran::of(output)
    }

    /// Runs the command with a standard input and variables.
    pub(crate) fn run_with(&self, line: &str, stdin: &[u8], variables: &[(&str, &str)]) -> Ran {
        let mut child = Command::new(env!("CARGO_BIN_EXE_motet"))
            .args(line.split_whitespace())
            .current_dir(&self.folder)
            .env_remove("NO_COLOR")
            .envs(variables.iter().copied())
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the command starts");
        // The command may end without reading its input.
        let _ = child.stdin.take().expect("a pipe was asked for").write_all(stdin);
        let output = child.wait_with_output().expect("the command ends");
        Ran::of(output)
    }
}

impl Ran {
    fn of(output: Output) -> Self {
        Self {
            code: output.status.code(),
            stdout: String::from_utf8(output.stdout).expect("output is UTF-8"),
            stderr: String::from_utf8(output.stderr).expect("output is UTF-8"),
        }
    }

    /// Asserts the exit code, and that each text is in standard output or standard error: `out:…` or `err:…`.
    pub(crate) fn check(&self, code: i32, texts: &[&str]) -> &Self {
        assert_eq!(self.code, Some(code), "{self:#?}");
        for text in texts {
            let (from, text) = text.split_once(':').expect("`out:` or `err:`");
            let stream = if from == "out" { &self.stdout } else { &self.stderr };
            assert!(stream.contains(text), "{text:?} is not in {from}: {self:#?}");
        }
        self
    }
}

/// A policy that is right.
pub(crate) const GOOD: &str = "policy tidy for hsr {\n    go(kitchen_table)\n    let mug = detect(\"red \
    mug\")\n    pick(mug)\n    go(counter)\n    place(mug, counter)\n}\n";

/// The same in JSON.
pub(crate) const GOOD_JSON: &str = r#"{"motet": 1, "policy": "tidy", "robot": "hsr", "steps": [
  {"do": "go", "to": "kitchen_table"},
  {"do": "detect", "what": "red mug", "as": "mug"},
  {"do": "pick", "object": "$mug"},
  {"do": "go", "to": "counter"},
  {"do": "place", "object": "$mug", "on": "counter"}]}
"#;

/// A policy with a misspelled primitive.
pub(crate) const BAD: &str = "policy tidy for hsr {\n    goo(kitchen_table)\n}\n";
