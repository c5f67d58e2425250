//! `motet serve`: an endpoint in the protocol of OpenAI in front of a model server. It adds the prompt, the
//! grammar, the check and the repair, so that its clients get only policies that check.

mod answer;
mod gateway;
mod http;
mod request;

use std::net::SocketAddr;
use std::sync::Arc;

use clap::{Args, value_parser};

use crate::error::{CliError, Exit};
use crate::flags::{DiagnosticFormat, ServerArgs, SessionArgs, SyntaxArg, token_from};
use crate::interrupt::catch_interrupts;
use crate::output::{Colors, note};
use crate::report::Report;
use gateway::{Gateway, Limits};

/// Flags of `motet serve`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    motet serve --planner http://localhost:8000 --model NAME --dialect vllm --robot hsr --scene kitchen\n  \
    motet serve --planner https://api.anthropic.com --model NAME --dialect anthropic --carrier none \\\n    \
    --key-file key.txt --robot hsr --scene kitchen --listen 127.0.0.1:4000")]
pub(crate) struct ServeArgs {
    #[command(flatten)]
    session: SessionArgs,
    /// Address of the model server, such as http://localhost:8000
    #[arg(long, value_name = "URL")]
    planner: String,
    #[command(flatten)]
    server: ServerArgs,
    /// Address to listen on; port 0 takes a free one
    #[arg(long, default_value = "127.0.0.1:8080", value_name = "ADDRESS")]
    listen: SocketAddr,
    /// Environment variable with a token that clients have to send as their API key
    #[arg(long, value_name = "VARIABLE")]
    token_from: Option<String>,
    /// Syntax of the policies in the replies
    #[arg(long, value_enum, default_value = "json", value_name = "SYNTAX")]
    syntax: SyntaxArg,
    /// Largest number of requests at a time; more are refused with 429
    #[arg(long, default_value_t = 4, value_name = "N", value_parser = value_parser!(u16).range(1..=256))]
    parallel: u16,
    /// Largest size of a request, in MiB
    #[arg(long, default_value_t = 32, value_name = "MIB", value_parser = value_parser!(u16).range(1..=1024))]
    max_body: u16,
}

/// Runs the command.
pub(crate) fn run(args: &ServeArgs, colors: Colors) -> Result<Exit, CliError> {
    Report::run(DiagnosticFormat::Human, colors, |report| serve(args, report))
}

fn serve(args: &ServeArgs, report: &mut Report) -> Result<Exit, CliError> {
    let settings = args.server.settings(&args.planner)?;
    let token = args.token_from.as_deref().map(token_from).transpose()?;
    if settings.key.is_some() && token.is_none() && !args.listen.ip().is_loopback() {
        return Err(CliError::Advised {
            problem: "other machines could use your key".to_owned(),
            help: "listen on 127.0.0.1, or give a token that clients have to send with --token-from VARIABLE"
                .to_owned(),
        });
    }
    let opened = args.session.project_here()?.open_with(report)?.into_session(report)?;
    let Some(robot) = opened.robot.clone() else {
        return Err(CliError::Message("policies need a robot: give --robot NAME".to_owned()));
    };
    let limits = Limits { parallel: args.parallel.into(), body: usize::from(args.max_body) << 20 };
    let gateway = Gateway {
        may_pass_keys: args.server.key.may_go_to(&settings.address),
        settings,
        token,
        robot,
        opened,
        repairs: args.server.repair,
        syntax: args.syntax.into(),
        limits,
        is_local: args.listen.ip().is_loopback(),
    };
    catch_interrupts()?;
    let cannot = |why: std::io::Error| CliError::Message(format!("cannot listen on {}: {why}", args.listen));
    let listener = std::net::TcpListener::bind(args.listen).map_err(cannot)?;
    let address = listener.local_addr().map_err(cannot)?;
    if !args.listen.ip().is_loopback() {
        note("warning: the traffic is not encrypted: put a proxy with TLS in front");
    }
    report.out.line(&format!("listening on http://{address}/v1"));
    http::serve(listener, Arc::new(gateway), limits).map_err(cannot)?;
    Ok(Exit::Success)
}
