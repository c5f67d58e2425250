//! `motet journal push` and `pull`: journals in an archive, which is a folder, S3 or Google Cloud Storage.

use crate::link::say;
use object_store::path::Path as Place;
use object_store::{ObjectStore, ObjectStoreExt as _};
use sha2::{Digest as _, Sha256};
use std::collections::BTreeMap;
use std::io::{Read as _, Seek as _, SeekFrom, Write as _};
use std::path::{Path, PathBuf};
use url::Url;

/// List of the objects of a journal in the archive, with their checksums, as `sha256sum --check` reads it. It
/// is written last. A file that is larger than [`PART`] is in several objects, `NAME@NUMBER-DIGITS`; the
/// checksum of the whole is in a comment.
const LIST: &str = "SHA256SUMS";
/// Bytes of an object at most, so that a push that was cut off begins little anew.
const PART: u64 = 16 * 1024 * 1024;
/// Bytes that are read or fetched at a time.
const CHUNK: u64 = 4 * 1024 * 1024;
/// Digits of the checksum of a part that are in its name.
const DIGITS: usize = 16;

#[derive(clap::Args, Debug)]
pub(crate) struct JournalArgs {
    #[command(subcommand)]
    command: Command,
}

#[derive(clap::Subcommand, Debug)]
enum Command {
    /// Copy a journal into an archive; files that are there already are not sent again
    Push {
        /// Folder of the journal
        folder: PathBuf,
        /// Archive: file:///FOLDER/NAME, s3://BUCKET/NAME or gs://BUCKET/NAME; keys come from the environment
        url: Url,
    },
    /// Copy a journal from an archive; files that are here already are not fetched again
    Pull {
        /// Archive: file:///FOLDER/NAME, s3://BUCKET/NAME or gs://BUCKET/NAME; keys come from the environment
        url: Url,
        /// Folder of the journal
        folder: PathBuf,
    },
}

/// Carries a command out.
pub(crate) async fn run(args: JournalArgs) -> Result<u8, String> {
    match args.command {
        Command::Push { folder, url } => push(&folder, &url).await,
        Command::Pull { url, folder } => pull(&url, &folder).await,
    }
}

/// The archive of an address, with the place of the journal in it.
fn archive(url: &Url) -> Result<(Box<dyn ObjectStore>, Place), String> {
    if url.scheme() == "file" {
        let folder = url.to_file_path().map_err(|()| format!("{url} is no folder"))?;
        std::fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
        let store = object_store::local::LocalFileSystem::new_with_prefix(&folder)
            .map_err(|error| error.to_string())?;
        return Ok((Box::new(store), Place::default()));
    }
    // Keys and regions come from the environment, never from the command line.
    let options =
        std::env::vars().filter(|(name, _)| name.starts_with("AWS_") || name.starts_with("GOOGLE_"));
    object_store::parse_url_opts(url, options.map(|(name, value)| (name.to_lowercase(), value)))
        .map_err(|error| error.to_string())
}

fn names(folder: &Path) -> Result<Vec<String>, String> {
    let entries = std::fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let files = entries.filter_map(|entry| Some(entry.ok()?.path())).filter(|path| path.is_file());
    let mut names: Vec<String> =
        files.filter_map(|path| Some(path.file_name()?.to_str()?.to_owned())).collect();
    // A name with `@` is that of a part.
    names.retain(|name| !name.contains('@'));
    names.retain(|name| name != "lock" && name != LIST && !name.starts_with('.') && !name.ends_with(".part"));
    names.sort();
    Ok(names)
}

/// Checksum of a part of a file, and the number of its bytes.
fn checksum(path: &Path, from: u64, most: u64) -> Result<(String, u64), String> {
    let wrong = |error: std::io::Error| format!("{}: {error}", path.display());
    let mut file = std::fs::File::open(path).map_err(wrong)?;
    file.seek(SeekFrom::Start(from)).map_err(wrong)?;
    let (mut part, mut sum, mut size) = (file.take(most), Sha256::new(), 0);
    let mut bytes = vec![0; usize::try_from(CHUNK.min(most)).unwrap_or_default()];
    loop {
        match part.read(&mut bytes).map_err(wrong)? {
            0 => return Ok((crate::signed::hex(&sum.finalize()), size)),
            count => {
                sum.update(&bytes[..count]);
                size += count as u64;
            }
        }
    }
}

/// A file in an archive.
#[derive(Clone, PartialEq, Debug, Default)]
struct Archived {
    /// Checksum of the whole.
    sum: String,
    /// Objects in order, with their checksums.
    parts: Vec<(String, String)>,
}

/// Files of an archive by name.
#[derive(Clone, PartialEq, Debug, Default)]
struct Listed(BTreeMap<String, Archived>);

impl Listed {
    /// Reads the list of an archive, which is data: a name with a folder in it leads elsewhere.
    fn read(text: &str) -> Result<Self, String> {
        let mut files: BTreeMap<String, Archived> = BTreeMap::new();
        for line in text.lines() {
            let (line, is_whole) = line.strip_prefix("# ").map_or((line, false), |line| (line, true));
            let Some((sum, object)) = line.split_once("  ") else { continue };
            let name = object.split_once('@').map_or(object, |(name, _)| name);
            if object.contains(['/', '\\']) || name.is_empty() || name.starts_with('.') {
                return Err(format!("the archive has a file of the name `{}`", object.escape_debug()));
            }
            let file = files.entry(name.to_owned()).or_default();
            if is_whole || name == object {
                sum.clone_into(&mut file.sum);
            }
            if !is_whole {
                file.parts.push((object.to_owned(), sum.to_owned()));
            }
        }
        files.values_mut().for_each(|file| file.parts.sort());
        Ok(Self(files))
    }

    fn written(&self) -> String {
        let mut text = String::new();
        for (name, file) in &self.0 {
            text.extend(file.parts.iter().map(|(object, sum)| format!("{sum}  {object}\n")));
            if file.parts.iter().all(|(object, _)| object != name) {
                text.push_str(&format!("# {}  {name}\n", file.sum));
            }
        }
        text
    }

    /// Reads the list of an archive, which may not be there yet.
    async fn fetch(store: &dyn ObjectStore, place: &Place) -> Result<Self, String> {
        match store.get(&place.clone().join(LIST)).await {
            Ok(list) => {
                let list = list.bytes().await.map_err(|error| error.to_string())?;
                Self::read(&String::from_utf8_lossy(&list))
            }
            Err(object_store::Error::NotFound { .. }) => Ok(Self::default()),
            Err(error) => Err(error.to_string()),
        }
    }
}

async fn push(folder: &Path, url: &Url) -> Result<u8, String> {
    let (store, place) = archive(url)?;
    let sent = send(&*store, &place, folder, PART).await?;
    say(&format!(
        "{} of {} files sent, in {} of {} objects",
        sent.files, sent.of_files, sent.objects, sent.of_objects
    ));
    Ok(0)
}

/// Numbers of what a push has sent, of all that there is.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
struct Sent {
    files: usize,
    of_files: usize,
    objects: usize,
    of_objects: usize,
}

/// Sends the files of a journal in parts of at most so many bytes.
async fn send(store: &dyn ObjectStore, place: &Place, folder: &Path, part: u64) -> Result<Sent, String> {
    let mut there = Listed::fetch(store, place).await?;
    let names = names(folder)?;
    if !names.iter().any(|name| name.ends_with(".journal")) {
        return Err(format!("{} has no journal", folder.display()));
    }
    let mut sent = Sent { of_files: names.len(), ..Sent::default() };
    for name in &names {
        let path = folder.join(name);
        let known = there.0.get(name).cloned().unwrap_or_default();
        // A file may grow meanwhile: it is sent as long as it is now.
        let (sum, size) = checksum(&path, 0, u64::MAX)?;
        if known.sum == sum {
            sent.of_objects += known.parts.len();
            continue;
        }
        let mut parts = Vec::new();
        for number in 0..size.div_ceil(part).max(1) {
            let from = number * part;
            let (own, bytes) = read(&path, from, part.min(size - from))?;
            let object =
                if size <= part { name.clone() } else { format!("{name}@{number:06}-{}", &own[..DIGITS]) };
            // The name of a part has its content: one that is there was sent before the push was cut off.
            let is_part = object != *name;
            if !(is_part && is_there(store, &place.clone().join(object.as_str()), bytes.len() as u64).await?)
            {
                let put = store.put(&place.clone().join(object.as_str()), bytes.into()).await;
                put.map_err(|error| format!("{}: {error}", path.display()))?;
                sent.objects += 1;
            }
            parts.push((object, own));
        }
        sent.files += 1;
        sent.of_objects += parts.len();
        there.0.insert(name.clone(), Archived { sum, parts: parts.clone() });
        // After each file the list says what is there.
        let put = store.put(&place.clone().join(LIST), there.written().into()).await;
        put.map_err(|error| error.to_string())?;
        // Nothing names the parts of the file as it was before.
        for (object, _) in known.parts.iter().filter(|old| parts.iter().all(|new| new.0 != old.0)) {
            let _ = store.delete(&place.clone().join(object.as_str())).await;
        }
    }
    Ok(sent)
}

/// Reads a part of a file; its checksum and its bytes.
fn read(path: &Path, from: u64, size: u64) -> Result<(String, Vec<u8>), String> {
    let wrong = |error: std::io::Error| format!("{}: {error}", path.display());
    let mut file = std::fs::File::open(path).map_err(wrong)?;
    file.seek(SeekFrom::Start(from)).map_err(wrong)?;
    let mut bytes = Vec::new();
    file.take(size).read_to_end(&mut bytes).map_err(wrong)?;
    if (bytes.len() as u64) < size {
        return Err(format!("{} became shorter meanwhile", path.display()));
    }
    Ok((crate::signed::hex(&Sha256::digest(&bytes)), bytes))
}

/// Checks whether an object of a size is in the archive.
async fn is_there(store: &dyn ObjectStore, object: &Place, size: u64) -> Result<bool, String> {
    match store.head(object).await {
        Ok(found) => Ok(found.size == size),
        Err(object_store::Error::NotFound { .. }) => Ok(false),
        Err(error) => Err(error.to_string()),
    }
}

async fn pull(url: &Url, folder: &Path) -> Result<u8, String> {
    let (store, place) = archive(url)?;
    let there = Listed::fetch(&*store, &place).await?;
    if there.0.is_empty() {
        return Err(format!("{url} has no journal"));
    }
    std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut fetched = 0;
    for (name, file) in &there.0 {
        let path = folder.join(name);
        if path.is_file() && checksum(&path, 0, u64::MAX)?.0 == file.sum {
            continue;
        }
        let draft = folder.join(format!("{name}.part"));
        let wrong = |error: std::io::Error| format!("{}: {error}", draft.display());
        let has_begun = draft.exists();
        download(&*store, &place, file, &draft).await?;
        let mut is_right = checksum(&draft, 0, u64::MAX)?.0 == file.sum;
        if !is_right && has_begun {
            // What an earlier pull had begun may be of another file: once more from its start.
            std::fs::remove_file(&draft).map_err(wrong)?;
            download(&*store, &place, file, &draft).await?;
            is_right = checksum(&draft, 0, u64::MAX)?.0 == file.sum;
        }
        if !is_right {
            let _ = std::fs::remove_file(&draft);
            return Err(format!("the checksum of `{name}` is wrong"));
        }
        std::fs::rename(&draft, &path).map_err(wrong)?;
        fetched += 1;
    }
    say(&format!("{fetched} of {} files fetched", there.0.len()));
    Ok(0)
}

/// Fetches a file, from where an earlier fetch was cut off.
async fn download(
    store: &dyn ObjectStore,
    place: &Place,
    file: &Archived,
    path: &Path,
) -> Result<(), String> {
    let wrong = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let mut sizes = Vec::new();
    for (object, _) in &file.parts {
        let head = store.head(&place.clone().join(object.as_str())).await;
        sizes.push(head.map_err(|error| wrong(&error))?.size);
    }
    let draft = std::fs::File::options().create(true).truncate(false).write(true).open(path);
    let mut draft = draft.map_err(|error| wrong(&error))?;
    let mut at = draft.seek(SeekFrom::End(0)).map_err(|error| wrong(&error))?;
    if at > sizes.iter().sum() {
        draft.set_len(0).and_then(|()| draft.rewind()).map_err(|error| wrong(&error))?;
        at = 0;
    }
    let mut begin = 0;
    for ((object, _), size) in file.parts.iter().zip(sizes) {
        while at < begin + size {
            let range = at - begin..size.min(at - begin + CHUNK);
            let bytes = store.get_range(&place.clone().join(object.as_str()), range).await;
            let bytes = bytes.map_err(|error| wrong(&error))?;
            draft.write_all(&bytes).map_err(|error| wrong(&error))?;
            at += bytes.len() as u64;
        }
        begin += size;
    }
    draft.sync_all().map_err(|error| wrong(&error))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("motet-archive-{name}-{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).unwrap();
        folder
    }

    fn bytes(count: u64) -> Vec<u8> {
        (0..count).map(|at| u8::try_from(at % 251).unwrap()).collect()
    }

    #[tokio::test]
    async fn journal_comes_back_and_only_what_is_new_is_sent() {
        let (own, there, back) = (folder("own"), folder("there"), folder("back"));
        let large = bytes(PART + CHUNK + 17);
        std::fs::write(own.join("000000000000.journal"), &large).unwrap();
        std::fs::write(own.join("policy.motet"), "policy a for hsr { done }").unwrap();
        std::fs::write(own.join("lock"), "").unwrap();
        let url = Url::from_file_path(&there).unwrap();
        push(&own, &url).await.unwrap();
        let list = std::fs::read_to_string(there.join(LIST)).unwrap();
        assert_eq!(list.lines().count(), 4, "two parts, the whole, the policy; the lock stays here: {list}");
        assert_eq!(Listed::read(&list).unwrap().written(), list);
        // A fetch that was cut off goes on, also one that was of another file.
        let draft = back.join("000000000000.journal.part");
        for begun in [&large[..1000], &large[..large.len() - 5], b"other"] {
            std::fs::write(&draft, begun).unwrap();
            pull(&url, &back).await.unwrap();
            let journal = back.join("000000000000.journal");
            assert_eq!(std::fs::read(&journal).unwrap(), large);
            std::fs::remove_file(journal).unwrap();
        }
        // What is wrong in the archive is not taken.
        std::fs::write(there.join("policy.motet"), "policy b for hsr { done }").unwrap();
        std::fs::remove_file(back.join("policy.motet")).unwrap();
        assert!(pull(&url, &back).await.unwrap_err().contains("checksum of `policy.motet`"));
        for folder in [own, there, back] {
            std::fs::remove_dir_all(folder).unwrap();
        }
    }

    #[tokio::test]
    async fn push_that_was_cut_off_goes_on_with_the_part_that_is_missing() {
        let (own, there, back) = (folder("cut-own"), folder("cut-there"), folder("cut-back"));
        let (path, part) = (own.join("000000000000.journal"), 1000);
        let url = Url::from_file_path(&there).unwrap();
        let (store, place) = archive(&url).unwrap();
        std::fs::write(&path, bytes(4500)).unwrap();
        // A folder in the place of the third part: the archive cannot take it.
        let third = format!("000000000000.journal@000002-{}", &read(&path, 2000, part).unwrap().0[..DIGITS]);
        std::fs::create_dir_all(there.join(&third).join("inside")).unwrap();
        assert!(send(&*store, &place, &own, part).await.is_err());
        assert!(pull(&url, &back).await.unwrap_err().contains("has no journal"), "half a file is none");
        std::fs::remove_dir_all(there.join(&third)).unwrap();
        let sent = send(&*store, &place, &own, part).await.unwrap();
        assert_eq!(sent, Sent { files: 1, of_files: 1, objects: 3, of_objects: 5 });
        pull(&url, &back).await.unwrap();
        assert_eq!(std::fs::read(back.join("000000000000.journal")).unwrap(), bytes(4500));
        // Of a file that has grown, only its end is sent, and its old end goes.
        std::fs::write(&path, bytes(5200)).unwrap();
        let sent = send(&*store, &place, &own, part).await.unwrap();
        assert_eq!(sent, Sent { files: 1, of_files: 1, objects: 2, of_objects: 6 });
        assert_eq!(std::fs::read_dir(&there).unwrap().count(), 7, "six parts and the list");
        assert_eq!(send(&*store, &place, &own, part).await.unwrap().objects, 0);
        pull(&url, &back).await.unwrap();
        assert_eq!(std::fs::read(back.join("000000000000.journal")).unwrap(), bytes(5200));
        // A part that is wrong in the archive is not taken.
        std::fs::write(there.join(&third), bytes(1000)).unwrap();
        std::fs::remove_file(back.join("000000000000.journal")).unwrap();
        assert!(pull(&url, &back).await.unwrap_err().contains("checksum"));
        for folder in [own, there, back] {
            std::fs::remove_dir_all(folder).unwrap();
        }
    }

    #[tokio::test]
    async fn list_that_leads_elsewhere_is_refused() {
        let (there, back) = (folder("evil"), folder("victim"));
        for name in ["../outside", "a@../outside", "..", "@000000-00"] {
            std::fs::write(there.join(LIST), format!("00  {name}\n")).unwrap();
            let wrong = pull(&Url::from_file_path(&there).unwrap(), &back).await.unwrap_err();
            assert!(wrong.contains(&format!("`{name}`")), "{wrong}");
        }
        std::fs::remove_dir_all(there).unwrap();
        std::fs::remove_dir_all(back).unwrap();
    }
}
