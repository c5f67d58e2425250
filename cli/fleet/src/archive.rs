//! `motet journal push` and `pull`: journals in an archive, which is a folder, S3 or Google Cloud Storage.

use crate::link::say;
use object_store::path::Path as Place;
use object_store::{Attributes, ObjectStore, ObjectStoreExt as _, PutOptions, WriteMultipart};
use sha2::{Digest as _, Sha256};
use std::collections::BTreeMap;
use std::io::Read as _;
use std::path::{Path, PathBuf};
use url::Url;

/// List of the files of a journal in the archive, with their checksums. It is written last.
const LIST: &str = "SHA256SUMS";
/// Bytes that are read at a time.
const CHUNK: usize = 5 * 1024 * 1024;

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
    names.retain(|name| name != "lock" && name != LIST && !name.starts_with('.') && !name.ends_with(".part"));
    names.sort();
    Ok(names)
}

fn checksum(path: &Path) -> Result<String, String> {
    let wrong = |error: std::io::Error| format!("{}: {error}", path.display());
    let (mut file, mut sum, mut bytes) =
        (std::fs::File::open(path).map_err(wrong)?, Sha256::new(), vec![0; CHUNK]);
    loop {
        match file.read(&mut bytes).map_err(wrong)? {
            0 => return Ok(crate::signed::hex(&sum.finalize())),
            count => sum.update(&bytes[..count]),
        }
    }
}

/// Checksums of the files that an archive has.
async fn listed(store: &dyn ObjectStore, place: &Place) -> Result<BTreeMap<String, String>, String> {
    let list = match store.get(&place.clone().join(LIST)).await {
        Ok(list) => list.bytes().await.map_err(|error| error.to_string())?,
        Err(object_store::Error::NotFound { .. }) => return Ok(BTreeMap::new()),
        Err(error) => return Err(error.to_string()),
    };
    let text = String::from_utf8_lossy(&list).into_owned();
    let line = |line: &str| line.split_once("  ").map(|(sum, name)| (name.to_owned(), sum.to_owned()));
    Ok(text.lines().filter_map(line).collect())
}

async fn push(folder: &Path, url: &Url) -> Result<u8, String> {
    let (store, place) = archive(url)?;
    let mut there = listed(&*store, &place).await?;
    let (mut sent, names) = (0, names(folder)?);
    if !names.iter().any(|name| name.ends_with(".journal")) {
        return Err(format!("{} has no journal", folder.display()));
    }
    for name in &names {
        let path = folder.join(name);
        if there.get(name) == Some(&checksum(&path)?) {
            continue;
        }
        // A file may grow meanwhile: the list has the checksum of what was sent.
        let sum = upload(&*store, &place.clone().join(name.as_str()), &path).await?;
        there.insert(name.clone(), sum);
        sent += 1;
        // After each file the list says what is there: a push that was cut off goes on.
        let list: String = there.iter().map(|(name, sum)| format!("{sum}  {name}\n")).collect();
        let put = store.put(&place.clone().join(LIST), list.into()).await;
        put.map_err(|error| error.to_string())?;
    }
    say(&format!("{sent} of {} files sent", names.len()));
    Ok(0)
}

/// Sends a file; the checksum of what was sent.
async fn upload(store: &dyn ObjectStore, place: &Place, path: &Path) -> Result<String, String> {
    let wrong = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let mut file = std::fs::File::open(path).map_err(|error| wrong(&error))?;
    let mut bytes = vec![0; CHUNK];
    let (mut upload, mut sum): (Option<WriteMultipart>, _) = (None, Sha256::new());
    loop {
        let mut filled = 0;
        while filled < bytes.len() {
            match file.read(&mut bytes[filled..]).map_err(|error| wrong(&error))? {
                0 => break,
                count => filled += count,
            }
        }
        sum.update(&bytes[..filled]);
        if upload.is_none() && filled < bytes.len() {
            let small = bytes[..filled].to_vec();
            let options = PutOptions { attributes: Attributes::new(), ..PutOptions::default() };
            store.put_opts(place, small.into(), options).await.map_err(|error| wrong(&error))?;
            break;
        }
        if upload.is_none() {
            let begun = store.put_multipart(place).await.map_err(|error| wrong(&error))?;
            upload = Some(WriteMultipart::new(begun));
        }
        if let Some(upload) = &mut upload {
            upload.wait_for_capacity(4).await.map_err(|error| wrong(&error))?;
            upload.write(&bytes[..filled]);
        }
        if filled < bytes.len() {
            break;
        }
    }
    if let Some(upload) = upload {
        upload.finish().await.map_err(|error| wrong(&error))?;
    }
    Ok(crate::signed::hex(&sum.finalize()))
}

async fn pull(url: &Url, folder: &Path) -> Result<u8, String> {
    let (store, place) = archive(url)?;
    let there = listed(&*store, &place).await?;
    if there.is_empty() {
        return Err(format!("{url} has no journal"));
    }
    std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut fetched = 0;
    for (name, sum) in &there {
        // The list is data: a name with a folder in it leads elsewhere.
        if name.contains(['/', '\\']) || name.starts_with('.') {
            return Err(format!("the archive has a file of the name `{}`", name.escape_debug()));
        }
        let path = folder.join(name);
        if path.is_file() && checksum(&path)? == *sum {
            continue;
        }
        let part = folder.join(format!("{name}.part"));
        let from = place.clone().join(name.as_str());
        let has_begun = part.exists();
        download(&*store, &from, &part).await?;
        let mut is_right = checksum(&part)? == *sum;
        if !is_right {
            // What an earlier pull had begun may be of another file: once more from its start.
            std::fs::remove_file(&part).map_err(|error| format!("{}: {error}", part.display()))?;
            if has_begun {
                download(&*store, &from, &part).await?;
                is_right = checksum(&part)? == *sum;
            }
        }
        if !is_right {
            let _ = std::fs::remove_file(&part);
            return Err(format!("the checksum of `{name}` is wrong"));
        }
        std::fs::rename(&part, &path).map_err(|error| format!("{}: {error}", path.display()))?;
        fetched += 1;
    }
    say(&format!("{fetched} of {} files fetched", there.len()));
    Ok(0)
}

/// Fetches a file, from where an earlier fetch was cut off.
async fn download(store: &dyn ObjectStore, place: &Place, path: &Path) -> Result<(), String> {
    use std::io::{Seek as _, SeekFrom, Write as _};
    let wrong = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let size = store.head(place).await.map_err(|error| wrong(&error))?.size;
    let file = std::fs::File::options().create(true).truncate(false).write(true).open(path);
    let mut file = file.map_err(|error| wrong(&error))?;
    let mut at = file.seek(SeekFrom::End(0)).map_err(|error| wrong(&error))?;
    if at > size {
        file.set_len(0).and_then(|()| file.rewind()).map_err(|error| wrong(&error))?;
        at = 0;
    }
    while at < size {
        let end = size.min(at + CHUNK as u64);
        let bytes = store.get_range(place, at..end).await.map_err(|error| wrong(&error))?;
        file.write_all(&bytes).map_err(|error| wrong(&error))?;
        at = end;
    }
    file.sync_all().map_err(|error| wrong(&error))
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

    #[tokio::test]
    async fn a_journal_comes_back_and_only_what_is_new_is_sent() {
        let (own, there, back) = (folder("own"), folder("there"), folder("back"));
        let large: Vec<u8> = (0..2 * CHUNK + 17).map(|at| u8::try_from(at % 251).unwrap()).collect();
        std::fs::write(own.join("000000000000.journal"), &large).unwrap();
        std::fs::write(own.join("policy.motet"), "policy a for hsr { done }").unwrap();
        std::fs::write(own.join("lock"), "").unwrap();
        let url = Url::from_file_path(&there).unwrap();
        push(&own, &url).await.unwrap();
        let listed_of = |folder: &Path| std::fs::read_to_string(folder.join(LIST)).unwrap();
        assert_eq!(listed_of(&there).lines().count(), 2, "the lock stays here");
        // A fetch that was cut off goes on.
        std::fs::write(back.join("000000000000.journal.part"), &large[..1000]).unwrap();
        pull(&url, &back).await.unwrap();
        assert_eq!(std::fs::read(back.join("000000000000.journal")).unwrap(), large);
        // What is wrong in the archive is not taken.
        std::fs::write(there.join("policy.motet"), "policy b for hsr { done }").unwrap();
        std::fs::remove_file(back.join("policy.motet")).unwrap();
        assert!(pull(&url, &back).await.unwrap_err().contains("checksum"));
        for folder in [own, there, back] {
            std::fs::remove_dir_all(folder).unwrap();
        }
    }

    #[tokio::test]
    async fn a_list_that_leads_elsewhere_is_refused() {
        let (there, back) = (folder("evil"), folder("victim"));
        std::fs::write(there.join(LIST), "00  ../outside\n").unwrap();
        let wrong = pull(&Url::from_file_path(&there).unwrap(), &back).await.unwrap_err();
        assert!(wrong.contains("`../outside`"), "{wrong}");
        std::fs::remove_dir_all(there).unwrap();
        std::fs::remove_dir_all(back).unwrap();
    }
}
