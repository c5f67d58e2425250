//! Writes random policies as trees of BehaviorTree.CPP, each with the actions that the engine starts in
//! the world of its seed: `trees FOLDER COUNT`. For `tests/peers/btcpp/run.sh`.

use std::error::Error;
use std::fs;
use std::path::PathBuf;

use motet_tests::trees;

fn main() -> Result<(), Box<dyn Error>> {
    let mut args = std::env::args().skip(1);
    let folder = PathBuf::from(args.next().ok_or("the folder is missing")?);
    let count: usize = args.next().ok_or("the count is missing")?.parse()?;
    fs::create_dir_all(&folder)?;
    for case in trees::cases().take(count) {
        let name = folder.join(format!("{}", case.seed));
        fs::write(name.with_extension("xml"), &case.tree)?;
        fs::write(name.with_extension("motet"), &case.text)?;
        let mut lines = case.account.actions.clone();
        lines.push(case.account.end.clone());
        fs::write(name.with_extension("expected"), lines.join("\n") + "\n")?;
    }
    Ok(())
}
