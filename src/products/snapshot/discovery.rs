//! [`discover`]: finds the scenes in folders and lists the paths of their references. Also finds orphaned references:
//! references whose scene does not exist, or which the settings do not include.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::file_kind::{has_reference_mark, looks_like_scene};
use super::filter::Filter;
use super::reference::{Part, parts};
use super::setting::{self, SETTINGS_FILE, Settings, matches_pattern};
use super::store;
use crate::mechanics::scene::{Scene, SceneError, isolate};

/// An error in the input of a check.
#[derive(Debug, thiserror::Error)]
pub enum DiscoveryError {
    /// A scene that is not valid.
    #[error("{}: {problems}", path.display())]
    Scene {
        /// The path of the scene file.
        path: PathBuf,
        /// The problems of the scene.
        problems: SceneError,
    },
    /// A file or folder that cannot be read.
    #[error("cannot read {}: {reason}", path.display())]
    Unreadable {
        /// The path of the file or folder.
        path: PathBuf,
        /// The message of the operating system.
        reason: String,
    },
    /// A settings file that is not valid.
    #[error("{}:{problem}", path.display())]
    Settings {
        /// The path of the settings file.
        path: PathBuf,
        /// Line, column and message.
        problem: String,
    },
    /// Two scenes with the same reference file.
    #[error("{0}")]
    Clash(String),
}

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
    /// Scenes that could not be read because of an error in the program, each with a description of the error.
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
/// All errors in scenes and settings, files that cannot be read, and scenes that would share a reference.
pub fn discover(places: &[PathBuf], only: Option<&str>) -> Result<Discovered, Vec<DiscoveryError>> {
    let mut search = SnapshotSearch::default();
    search.add_places(places);
    let names = search.candidates.iter().map(|(_, base)| shown(base));
    let filter = Filter::new(only, names);
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
        if !filter.selects(&name) {
            continue;
        }
        match isolate(&shown(&path), || Scene::from_slice(&bytes)) {
            Err(fault) => faults.push((path, fault)),
            Ok(Err(problems)) => search.errors.push(DiscoveryError::Scene { path, problems }),
            Ok(Ok(scene)) => jobs.push(Job { path, name, scene: Arc::new(scene), settings, parts }),
        }
    }
    if !search.errors.is_empty() {
        return Err(search.errors);
    }
    let orphans = search.orphans(&expected);
    let orphans = orphans.into_iter().filter(|(path, _)| filter.selects(&shown(path)));
    Ok(Discovered { orphans: orphans.collect(), jobs, faults })
}

/// Returns a path as text, with `/` between folders on every operating system and without `./` at the beginning.
pub(super) fn shown(path: &Path) -> String {
    let shown = path.to_string_lossy().replace('\\', "/");
    shown.strip_prefix("./").unwrap_or(&shown).to_owned()
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
    errors: Vec<DiscoveryError>,
}

impl SnapshotSearch {
    /// Adds the given scene files, and all scene files in the given folders, to the candidates.
    fn add_places(&mut self, places: &[PathBuf]) {
        for place in places {
            match fs::metadata(place) {
                Ok(data) if data.is_dir() => self.add_folder(place),
                Ok(_) => self.add_scene(place.clone(), place.with_extension("")),
                Err(error) => self.report_unreadable(place, &error),
            }
        }
    }

    fn report_unreadable(&mut self, path: &Path, error: &std::io::Error) {
        self.errors.push(DiscoveryError::Unreadable { path: path.to_owned(), reason: error.to_string() });
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
            match path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase()).as_deref() {
                _ if name.starts_with('.') || name == "node_modules" => {}
                _ if is_folder => self.add_folder(&path),
                _ if name == SETTINGS_FILE => self.add_listed_scenes(folder),
                Some("json") => self.add_scene(path.clone(), path.with_extension("")),
                Some("txt" | "svg" | "png") if !store::is_result_file(&name) => self.others.push(path),
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
            let place = folder.join(place);
            match fs::metadata(&place) {
                Ok(data) if data.is_dir() => {
                    let mut there = SnapshotSearch::default();
                    there.add_folder(&place);
                    for (path, _) in there.candidates {
                        let name = path.file_stem().unwrap_or_default().to_owned();
                        self.add_scene(path, folder.join(name));
                    }
                    self.errors.extend(there.errors);
                }
                Ok(_) => {
                    let name = place.file_stem().unwrap_or_default().to_owned();
                    self.add_scene(place, folder.join(name));
                }
                Err(error) => self.report_unreadable(&place, &error),
            }
        }
    }

    fn add_scene(&mut self, path: PathBuf, base: PathBuf) {
        self.candidates.push((path, base));
    }

    /// Returns the settings of the nearest settings file of a folder, or the defaults if there is none; `None` if the file
    /// cannot be read or is not valid. Adds the errors of this file to `errors`.
    fn settings_of(&mut self, folder: &Path) -> Option<Arc<Settings>> {
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        let file = setting::nearest(folder);
        if let Some(known) = self.known.get(&file) {
            return known.clone();
        }
        let read = match &file {
            None => Some(Settings::default()),
            Some(path) => match fs::read_to_string(path) {
                Err(error) => {
                    self.report_unreadable(path, &error);
                    None
                }
                Ok(text) => Settings::read(&text)
                    .map_err(|problems| {
                        let described = problems
                            .into_iter()
                            .map(|problem| DiscoveryError::Settings { path: path.clone(), problem });
                        self.errors.extend(described);
                    })
                    .ok(),
            },
        };
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
            self.errors.push(DiscoveryError::Clash(format!(
                "{} and {} would both have the reference {} on file systems that ignore case; rename one of them",
                shown(&other),
                shown(scene),
                shown(file)
            )));
        }
    }

    /// Returns the bytes of a scene file; `None` if the file is not a drystone scene, the settings ignore it, or it
    /// cannot be read. `base` is the path of its references without their extensions, and `parts` are these references.
    fn scene_bytes(&mut self, path: &Path, base: &Path, settings: &Settings, parts: &[Part]) -> Option<Vec<u8>> {
        let below = setting::nearest(base.parent().unwrap_or(Path::new("."))).and_then(|file| {
            let folder = file.parent()?.to_owned();
            let path = std::path::absolute(path).ok()?;
            Some(shown(path.strip_prefix(folder).ok()?))
        });
        let ignored = |pattern: &String| below.as_deref().is_some_and(|below| matches_pattern(pattern, below));
        if settings.ignore.iter().any(ignored) {
            return None;
        }
        let bytes = match fs::read(path) {
            Ok(bytes) => bytes,
            Err(error) => {
                self.report_unreadable(path, &error);
                return None;
            }
        };
        // Skip JSON files of other programs. A file that has references counts as a scene even without the key
        // `"drystone"`, so that the missing key is reported.
        (looks_like_scene(&bytes) || parts.iter().any(|p| p.file.exists())).then_some(bytes)
    }

    /// Returns the orphaned reference files, each with the reason and the remedy. `expected` has the references of
    /// all scenes.
    fn orphans(&self, expected: &BTreeMap<PathBuf, PathBuf>) -> Vec<(PathBuf, String)> {
        let fold = |path: &Path| PathBuf::from(path.to_string_lossy().to_lowercase());
        let mut stems: BTreeSet<PathBuf> = BTreeSet::new();
        for file in expected.keys() {
            stems.insert(file.with_extension(""));
        }
        // Facts and pictures contain a mark that identifies them as references; SVG files do not. A file with the same
        // name as a marked file, but another extension, counts as a reference too.
        let marked: Vec<&PathBuf> = self.others.iter().filter(|p| has_reference_mark(p)).collect();
        let mut orphans = Vec::new();
        for path in &self.others {
            if expected.contains_key(&fold(path)) {
                continue;
            }
            let stem = path.with_extension("");
            let same_stem = marked.iter().any(|t| t.with_extension("") == stem);
            let of_a_scene = stems.iter().any(|s| {
                let (own, s) = (fold(&stem).to_string_lossy().into_owned(), s.to_string_lossy());
                own.strip_prefix(s.as_ref()).is_some_and(|rest| rest.starts_with('.'))
            });
            if same_stem || of_a_scene {
                let words = if of_a_scene {
                    "the settings of its scene do not include this reference; delete it"
                } else {
                    "its scene does not exist; delete the reference or restore the scene"
                };
                orphans.push((path.clone(), words.to_owned()));
            }
        }
        orphans
    }
}
