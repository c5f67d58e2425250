//! Page of a run that goes on: its feed, its hub and its server.

use std::cell::RefCell;
use std::io::{self, IsTerminal as _};
use std::net::SocketAddr;
use std::path::Path;
use std::rc::Rc;
use std::sync::Arc;

use motet_project::ProjectSession;
use motet_runtime::Moved;
use motet_runtime::journal::JournalEntry;
use serde_json::{Value, json};
use smol_str::SmolStr;

use super::hub::Hub;
use super::server::Server;
use crate::error::CliError;
use crate::flags::PageArgs;
use crate::interrupt::{SLICE, is_interrupted};
use crate::output::{note, replace_secret};
use motet::page::feed::PageFeed;
use motet::page::source::PolicyText;
use motet::page::world::PageWorld;
use motet::workbench::Workbench;

/// Page that the observer of a run and its operator share.
pub(crate) type SharedPage = Rc<RefCell<LivePage>>;

/// Page of a run.
pub(crate) struct LivePage {
    feed: PageFeed,
    hub: Arc<Hub>,
    server: Option<Server>,
    /// Number of the entry that came last, and of the items that followed it.
    last: (u64, u32),
    /// Motion since the last report that went out.
    unsent: Moved,
    /// Number of questions of the dialogue.
    questions: u32,
}

impl LivePage {
    /// Serves a page at an address, and says where: in a file if one is given, otherwise on stderr. `takes`
    /// names the commands of its operator.
    pub(crate) fn start(
        address: SocketAddr,
        file: Option<&Path>,
        opened: Option<&ProjectSession>,
        takes: &[&str],
    ) -> Result<Self, CliError> {
        let hub = Arc::new(Hub::default());
        let server = Server::start(address, Arc::clone(&hub), None)?;
        match file {
            Some(file) => replace_secret(file, &server.url())?,
            None => note(&format!("the page is at {}", server.url())),
        }
        Ok(Self::served(server, hub, opened, takes))
    }

    /// Serves a page with a workbench at an address, and says where.
    pub(crate) fn workbench(address: SocketAddr, bench: Workbench) -> Result<Self, CliError> {
        let hub = Arc::new(Hub::default());
        let server = Server::start(address, Arc::clone(&hub), Some(bench))?;
        note(&format!("the page is at {}", server.url()));
        Ok(Self::served(server, hub, None, &["ask"]))
    }

    fn served(server: Server, hub: Arc<Hub>, opened: Option<&ProjectSession>, takes: &[&str]) -> Self {
        let mut page = Self::silent(hub, opened, takes);
        page.server = Some(server);
        page
    }

    /// Page of the flags, if they ask for one.
    pub(crate) fn shared(
        args: &PageArgs,
        opened: &ProjectSession,
        takes: &[&str],
    ) -> Result<Option<SharedPage>, CliError> {
        let page =
            args.view.map(|address| Self::start(address, args.view_file.as_deref(), Some(opened), takes));
        Ok(page.transpose()?.map(|page| Rc::new(RefCell::new(page))))
    }

    /// Page that nobody serves yet.
    pub(crate) fn silent(hub: Arc<Hub>, opened: Option<&ProjectSession>, takes: &[&str]) -> Self {
        let mut world = opened.and_then(PageWorld::of);
        hub.push("0-0", &json!({"t": "hello", "takes": takes}));
        if let Some(world) = &mut world {
            hub.push("0-1", &world.item());
        }
        let feed = PageFeed::new(world);
        Self { feed, hub, server: None, last: (0, 0), unsent: Moved::default(), questions: 0 }
    }

    /// Hub of the page.
    pub(crate) fn hub(&self) -> Arc<Hub> {
        Arc::clone(&self.hub)
    }

    /// Sets the text of the policy that begins or takes over next.
    pub(crate) fn text(&mut self, text: PolicyText) {
        self.feed.text = Some(text);
    }

    /// Number of the run, from 1; 0 before the first.
    pub(crate) fn run(&self) -> u32 {
        self.feed.run
    }

    /// Asks a question of the dialogue, which no step asks. Returns its id.
    pub(crate) fn question(&mut self, text: &str, options: &[SmolStr]) -> String {
        self.questions += 1;
        let id = format!("talk-{}", self.questions);
        self.item(&json!({"t": "question", "q": id, "text": text, "options": options}));
        id
    }

    /// Notes the answer to a question of the dialogue.
    pub(crate) fn answered(&mut self, question: &str, answer: Option<&str>) {
        self.item(&json!({"t": "answered", "q": question, "text": answer}));
    }

    /// Takes in the head of a run.
    pub(crate) fn begin(&mut self, head: JournalEntry) {
        // A wish from before the first run is for that one.
        if self.feed.run > 0 {
            self.hub.begin();
        }
        self.entry(0, &head);
    }

    /// Takes in an entry.
    pub(crate) fn entry(&mut self, seq: u64, entry: &JournalEntry) {
        self.last = (seq, 0);
        if let Some((id, item)) = self.feed.entry(seq, entry) {
            self.hub.push(&id, &item);
        }
    }

    /// Adds an item that is no entry: a request, a question of the dialogue, an answer.
    pub(crate) fn item(&mut self, item: &Value) {
        self.last.1 += 1;
        let id = format!("{}.{}", self.feed.id(self.last.0), self.last.1);
        self.hub.push(&id, item);
    }

    /// Takes in a report of motion.
    pub(crate) fn moved(&mut self, moved: &Moved) {
        let Some(world) = &mut self.feed.world else { return };
        self.unsent.merge(moved);
        if self.hub.wants_motion(moved.at) {
            self.hub.moved(&world.moved(&std::mem::take(&mut self.unsent)));
        }
    }

    /// Lets a person at a terminal look at a run that is over, and ends the server.
    pub(crate) fn finish(&mut self) {
        let Some(server) = self.server.take() else { return };
        if io::stdin().is_terminal() && !is_interrupted() {
            note("the page stays until Ctrl-C");
            while !is_interrupted() {
                std::thread::sleep(SLICE);
            }
        }
        server.finish();
    }
}
