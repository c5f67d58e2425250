//! Flags for many documents at once: threads, shards, and a file of results that can be continued.

use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::thread;

use clap::Args;
use motet::batch::Shard;

/// Threads and shards.
#[derive(Args, Clone, Copy, Debug, Default)]
pub(crate) struct JobArgs {
    /// Number of threads; the output is the same for any number [default: one for each core]
    #[arg(short, long, value_name = "N")]
    jobs: Option<NonZeroUsize>,
    /// Work on each N-th input only, from the K-th on, with K from 0 to N-1
    #[arg(long, value_name = "K/N")]
    shard: Option<Shard>,
}

impl JobArgs {
    /// Number of threads.
    pub(crate) fn jobs(self) -> usize {
        let all = || thread::available_parallelism().map_or(1, NonZeroUsize::get);
        self.jobs.map_or_else(all, |jobs| jobs.get().min(MAX_JOBS))
    }

    /// Is `true` if a flag of them is given.
    pub(crate) fn is_given(self) -> bool {
        self.jobs.is_some() || self.shard.is_some()
    }

    /// Share of the inputs.
    pub(crate) fn shard(self) -> Shard {
        self.shard.unwrap_or_default()
    }
}

/// Largest number of threads: more than a machine has.
const MAX_JOBS: usize = 1024;

/// File of results.
#[derive(Args, Clone, Debug, Default)]
pub(crate) struct ResultArgs {
    /// Write one JSON object per document to this file instead of the usual output
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    /// Continue a file of results that an earlier call of the same command has begun
    #[arg(long, requires = "out")]
    pub(crate) r#continue: bool,
}
