//! [`discover`]: finds the scenes in folders and lists the paths of their references. Also finds orphaned references:
//! references whose scene does not exist, or which the settings do not include.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::reference::{HASH_WORDS, Part, is_reference_suffix, parts};
use super::setting::{self, SETTINGS_FILE, Settings, matches_pattern};
use super::store;
use crate::mechanics::scene::{Code, Problem, Scene, SceneError, isolate};
use crate::read;

/// A scene to check.
#[derive(Clone, Debug)]
pub struct Job {
    /// The path of the scene file.
    pub path: PathBuf,
    /// The name of the scene in messages: the path of its references without their extensions, with `/` between
    /// folders. It is the path of the scene file without `.json`, unless a settings file lists the scene.
    pub name: String,
    /// The scene.
    pub scene: Arc<Scene>,
    /// The settings for the folder of the references.
    pub settings: Arc<Settings>,
    /// The references of the scene: first the facts, then SVG and pictures for each kind of figure.
    pub parts: Vec<Part>,
}

/// The result of [`discover`]: the scenes to check, and orphaned references.
#[derive(Debug, Default)]
pub struct Discovered {
    /// The scenes, sorted by the paths of their files.
    pub jobs: Vec<Job>,
    /// References whose scene does not exist or which the settings do not include, each with the reason and the remedy.
    pub orphans: Vec<(PathBuf, String)>,
    /// Scenes that are not valid, or that could not be read because of an error in the program, each with the problems.
    pub faults: Vec<(PathBuf, SceneError)>,
}

/// Finds all scenes in the given folders and scene files. Also finds all orphaned references: references without a
/// scene, and references that the settings do not include.
///
/// In a folder, a scene is a `.json` file that contains `"drystone"` or already has a reference. A file that is not
/// valid JSON counts as a damaged scene, and is reported, if it is empty, is not UTF-8, or contains `drystone`,
/// `blocks` or `polygon`. Hidden files and folders, `node_modules` and cache folders are skipped. The filter `only`
/// selects scenes in one of three ways:
///
/// 1. If the filter equals the name of a scene, it selects only this scene. Accepting `arch` thus does not accept
///    `arch2`.
/// 2. Otherwise, if the filter contains `*`, it is a pattern for the name.
/// 3. Otherwise the filter selects all scenes whose name contains it.
///
/// # Errors
/// All errors in settings, folders that cannot be read, and scenes that would share a reference. Scenes that are not valid
/// or cannot be read are no error: the other scenes are still checked.
pub fn discover(places: &[PathBuf], only: Option<&str>) -> Result<Discovered, Vec<String>> {
    let mut search = SnapshotSearch::default();
    search.add_places(places);
    let names: Vec<String> = search.candidates.iter().map(|(_, base)| shown(base)).collect();
    let selects = filter(only, &names);
    search.candidates.sort();
    search.candidates.dedup();
    let mut jobs = Vec::new();
    let mut faults = Vec::new();
    let mut expected: BTreeMap<PathBuf, PathBuf> = BTreeMap::new();
    for (path, base) in std::mem::take(&mut search.candidates) {
        let Some(settings) = search.settings_of(base.parent().unwrap_or(Path::new(""))) else {
            continue;
        };
        let parts = parts(&base, &settings);
        let Some(bytes) = search.scene_bytes(&path, &base, &settings, &parts) else {
            continue;
        };
        // Register the references of all scenes, even of scenes that the filter does not select. Otherwise these
        // references would count as orphans.
        for part in &parts {
            search.register(&path, &part.file, &mut expected);
        }
        let name = shown(&base);
        if !selects(&name) {
            continue;
        }
        let scene = match &bytes {
            Ok(bytes) => isolate(&shown(&path), || Scene::from_slice(bytes)).flatten(),
            Err(why) => {
                let problem = Problem::alone(Code::NotReadable, format!("it cannot be read: {why}"), "");
                Err(SceneError { list: vec![problem], text: None })
            }
        };
        match scene {
            Err(fault) => faults.push((path, fault)),
            Ok(scene) => jobs.push(Job { path, name, scene: Arc::new(scene), settings, parts }),
        }
    }
    if !search.errors.is_empty() {
        return Err(search.errors);
    }
    let orphans = search.orphans(&expected);
    let orphans = orphans.into_iter().filter(|(path, _)| selects(&shown(path)));
    Ok(Discovered { orphans: orphans.collect(), jobs, faults })
}

/// Returns a path as text, with `/` between folders on every operating system and without `./` at the beginning.
pub(super) fn shown(path: &Path) -> String {
    let shown = path.to_string_lossy().replace('\\', "/");
    shown.strip_prefix("./").unwrap_or(&shown).to_owned()
}

/// Reads a settings file.
///
/// # Errors
/// Messages that begin with the path of the file, or name it.
pub(super) fn settings_in(file: &Path) -> Result<Settings, Vec<String>> {
    let path = file.display();
    let text = read::file::text(file).map_err(|error| vec![format!("cannot read {path}: {error}")])?;
    Settings::read(&text).map_err(|problems| problems.iter().map(|problem| format!("{path}:{problem}")).collect())
}

/// The files and the errors that a search has found so far.
#[derive(Default)]
struct SnapshotSearch {
    /// Possible scenes. Each has the path of its file, and the path of its references without their extensions.
    candidates: Vec<(PathBuf, PathBuf)>,
    /// The paths of files that may be references.
    others: Vec<PathBuf>,
    /// Settings that have already been read, by file. The key `None` is for the default settings. The value `None` is
    /// for a file that cannot be read or is not valid.
    known: BTreeMap<Option<PathBuf>, Option<Arc<Settings>>>,
    errors: Vec<String>,
}

impl SnapshotSearch {
    /// Adds the given scene files, and all scene files in the given folders, to the candidates.
    fn add_places(&mut self, places: &[PathBuf]) {
        for place in places {
            match fs::metadata(place) {
                Ok(data) if data.is_dir() => self.add_folder(place),
                Ok(_) => self.candidates.push((place.clone(), place.with_extension(""))),
                Err(error) => self.report_unreadable(place, &error),
            }
        }
    }

    fn report_unreadable(&mut self, path: &Path, error: &std::io::Error) {
        self.errors.push(format!("cannot read {}: {error}", path.display()));
    }

    /// Collects the possible scenes and references of a folder and its subfolders. Skips hidden files, hidden folders,
    /// `node_modules` and folders with a file `CACHEDIR.TAG`.
    fn add_folder(&mut self, folder: &Path) {
        let entries: Result<Vec<_>, _> = fs::read_dir(folder).and_then(Iterator::collect);
        let mut entries: Vec<fs::DirEntry> = match entries {
            Ok(entries) => entries,
            Err(error) => return self.report_unreadable(folder, &error),
        };
        entries.sort_by_key(fs::DirEntry::file_name);
        if entries.iter().any(|e| e.file_name() == "CACHEDIR.TAG") {
            return;
        }
        for entry in entries {
            let path = entry.path();
            let name = entry.file_name().to_string_lossy().into_owned();
            // `file_type` does not follow symbolic links, which may form a cycle.
            let is_folder = entry.file_type().is_ok_and(|t| t.is_dir());
            match read::file::ending(&path).as_str() {
                _ if name.starts_with('.') || name == "node_modules" => {}
                _ if is_folder => self.add_folder(&path),
                _ if name == SETTINGS_FILE => self.add_listed_scenes(folder),
                "json" => self.candidates.push((path.clone(), path.with_extension(""))),
                "txt" | "svg" | "png" | "hash" if !store::is_result_file(&name) => self.others.push(path),
                _ => {}
            }
        }
    }

    /// Adds the scenes that the settings file in a folder lists under the key `scenes`.
    fn add_listed_scenes(&mut self, folder: &Path) {
        let Some(settings) = self.settings_of(folder) else {
            return;
        };
        for place in &settings.scenes {
            let mut there = SnapshotSearch::default();
            there.add_places(&[folder.join(place)]);
            let listed = there.candidates.into_iter().map(|(path, _)| {
                let base = folder.join(path.file_stem().unwrap_or_default());
                (path, base)
            });
            self.candidates.extend(listed);
            self.errors.extend(there.errors);
        }
    }

    /// Returns the settings of the nearest settings file of a folder, or the defaults if there is none; `None` if the file
    /// cannot be read or is not valid. Adds the errors of this file to `errors`.
    fn settings_of(&mut self, folder: &Path) -> Option<Arc<Settings>> {
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        let file = setting::nearest(folder);
        if let Some(known) = self.known.get(&file) {
            return known.clone();
        }
        let read = file.as_deref().map_or_else(|| Ok(Settings::default()), settings_in);
        let read = read.map_err(|errors| self.errors.extend(errors)).ok();
        let settings = read.map(Arc::new);
        self.known.insert(file, settings.clone());
        settings
    }

    /// Registers a reference file of a scene in `expected`. Adds an error if another scene has the same reference
    /// file. Paths are compared in lower case, because some file systems ignore case.
    fn register(&mut self, scene: &Path, file: &Path, expected: &mut BTreeMap<PathBuf, PathBuf>) {
        let folded = PathBuf::from(file.to_string_lossy().to_lowercase());
        if let Some(other) = expected.insert(folded, scene.to_owned())
            && other != scene
        {
            self.errors.push(format!(
                "{} and {} would both have the reference {} on file systems that ignore case; rename one of them",
                shown(&other),
                shown(scene),
                shown(file)
            ));
        }
    }

    /// Returns the bytes of a scene file, or the reason why it cannot be read; `None` if the file is not a drystone scene,
    /// or the settings ignore it. `base` is the path of its references without their extensions, and `parts` are these
    /// references.
    fn scene_bytes(
        &self,
        path: &Path,
        base: &Path,
        settings: &Settings,
        parts: &[Part],
    ) -> Option<std::io::Result<Vec<u8>>> {
        let below = setting::nearest(base.parent().unwrap_or(Path::new("."))).and_then(|file| {
            let folder = file.parent()?.to_owned();
            let path = std::path::absolute(path).ok()?;
            Some(shown(path.strip_prefix(folder).ok()?))
        });
        let ignored = |pattern: &String| below.as_deref().is_some_and(|below| matches_pattern(pattern, below));
        if settings.ignore.iter().any(ignored) {
            return None;
        }
        let bytes = match read::file::bytes(path) {
            Ok(bytes) => bytes,
            unreadable => return Some(unreadable),
        };
        // Skip JSON files of other programs. A file that has references counts as a scene even without the key
        // `"drystone"`, so that the missing key is reported.
        (looks_like_scene(&bytes) || parts.iter().any(|p| p.file.exists())).then_some(Ok(bytes))
    }

    /// Returns the orphaned reference files, each with the reason and the remedy. `expected` has the references of
    /// all scenes.
    fn orphans(&self, expected: &BTreeMap<PathBuf, PathBuf>) -> Vec<(PathBuf, String)> {
        let fold = |path: &Path| path.to_string_lossy().to_lowercase();
        let scenes: BTreeSet<String> = expected.keys().map(|file| fold(&file.with_extension(""))).collect();
        // Files of facts and of hashes begin with words that identify them as references; drawings and pictures do
        // not. They count as references if their name is the name of a marked file, or the name of a scene or marked
        // file with a suffix of references: `arch.dark.png`, but not `arch.photo.png`.
        let marked = self.others.iter().filter(|path| has_reference_mark(path));
        let marked: BTreeSet<String> = marked.map(|path| fold(&path.with_extension(""))).collect();
        let mut orphans = Vec::new();
        for path in self.others.iter().filter(|path| !expected.contains_key(&PathBuf::from(fold(path)))) {
            let stem = fold(&path.with_extension(""));
            let is_picture = path.extension().is_some_and(|extension| extension == "svg" || extension == "png");
            if !is_picture && !has_reference_mark(path) {
                continue;
            }
            let mut bases = stem.match_indices('.').map(|(dot, _)| (&stem[..dot], &stem[dot + 1..]));
            let base = bases.find(|(base, suffix)| {
                (scenes.contains(*base) || marked.contains(*base)) && is_reference_suffix(suffix)
            });
            let base = match base {
                Some((base, _)) => base,
                None if marked.contains(&stem) => &stem,
                None => continue,
            };
            let words = if scenes.contains(base) {
                "the settings of its scene do not include this reference; add it to the settings"
            } else {
                "its scene does not exist; restore the scene"
            };
            orphans.push((path.clone(), format!("{words}, or delete the reference with `drystone snapshot --prune`")));
        }
        orphans
    }
}

/// True if a file counts as a scene or as a damaged scene.
///
/// A file counts as a scene if it contains the text `"drystone"`, with the quotation marks. A file that is not valid
/// JSON counts as a damaged scene if it is empty, is not UTF-8, or contains `drystone`, `blocks` or `polygon`.
pub(crate) fn looks_like_scene(bytes: &[u8]) -> bool {
    let has = |word: &[u8]| bytes.windows(word.len()).any(|w| w == word);
    if has(b"\"drystone\"") {
        return true;
    }
    let is_meant = has(b"drystone") || has(b"blocks") || has(b"polygon");
    let is_empty = bytes.iter().all(u8::is_ascii_whitespace);
    if !is_meant && !is_empty && std::str::from_utf8(bytes).is_ok() {
        return false;
    }
    let is_damage =
        |code| matches!(code, Code::NotUtf8 | Code::EmptyFile | Code::EndsEarly | Code::NotJson | Code::OtherFormat);
    match isolate("a file", || Scene::from_slice(bytes)) {
        Ok(Err(problems)) => problems.list.iter().any(|problem| is_damage(problem.code)),
        _ => false,
    }
}

/// True if the first words of a file identify it as a reference of a scene. False if the file cannot be read.
fn has_reference_mark(path: &Path) -> bool {
    let mut head = Vec::new();
    let read = read::file::open(path).and_then(|file| file.take(32).read_to_end(&mut head));
    let marks = ["{\"drystone_facts\":", HASH_WORDS];
    read.is_ok() && marks.iter().any(|mark| head.starts_with(mark.as_bytes()))
}

/// Returns the filter for the text of `--only`, which selects scenes and references by their names; `None` selects all.
/// If the text equals one of the scene `names`, the filter selects only this scene and its references. Otherwise a text
/// with `*` is a pattern for names, with their folders or without, and any other text must occur in a name.
fn filter<'f>(only: Option<&'f str>, names: &[String]) -> impl Fn(&str) -> bool + use<'f> {
    let is_name = names.iter().any(|name| Some(name.as_str()) == only);
    move |name| match only {
        None => true,
        // The name of a reference is the name of its scene, a dot and more.
        Some(scene) if is_name => name.strip_prefix(scene).is_some_and(|rest| rest.is_empty() || rest.starts_with('.')),
        Some(pattern) if pattern.contains('*') => {
            let file = name.rsplit('/').next().unwrap_or_default();
            [name, file].iter().any(|name| matches_pattern(pattern, name))
        }
        Some(part) => name.contains(part),
    }
}
