//! Plans a policy for a request and runs it in simulation: `cargo run -p motet --example plan_and_run --
//! 'bring me the red mug'`.
#![allow(clippy::print_stdout, reason = "an example prints")]

use motet::Motet;

fn main() -> Result<(), motet::Error> {
    let request = std::env::args().nth(1).unwrap_or_else(|| "bring me the red mug".to_owned());
    let motet = Motet::open("hsr", "kitchen")?;
    let plan = motet.plan(&request)?;
    println!("{}", plan.text);
    let mut robot = motet.simulator(&plan.policy, 7)?;
    println!("{}", motet.run(&plan.policy, &mut robot)?);
    Ok(())
}
