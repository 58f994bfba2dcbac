//! [`discover`]: which scenes there are under some folders, where their references lie, and which references have none.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::check::Layer;
use super::setting::{self, FILE, Settings, fits};
use super::store;
use crate::figure::Kind;
use crate::scene::{Scene, SceneError, isolate};

/// Input that is wrong.
#[derive(Debug, thiserror::Error)]
pub enum DiscoveryError {
    /// A scene.
    #[error("{}: {problems}", path.display())]
    Scene {
        /// Its file.
        path: PathBuf,
        /// What is wrong with it.
        problems: SceneError,
    },
    /// A file or folder that cannot be read.
    #[error("cannot read {}: {why}", path.display())]
    Unread {
        /// Which.
        path: PathBuf,
        /// The system's reason.
        why: String,
    },
    /// A settings file.
    #[error("{}:{problem}", path.display())]
    Settings {
        /// Which.
        path: PathBuf,
        /// Line, column and what is wrong.
        problem: String,
    },
    /// Two scenes that would have the same references.
    #[error("{0}")]
    Clash(String),
}

/// A file that belongs to a snapshot.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// What it holds.
    pub layer: Layer,
    /// Where it lies.
    pub file: PathBuf,
    /// What its figure shows.
    pub kind: Kind,
    /// In which theme.
    pub theme: String,
    /// How wide, pixels; `None` for the drawing's own width.
    pub width: Option<u32>,
}

/// A scene to check.
#[derive(Clone, Debug)]
pub struct Job {
    /// Its file.
    pub path: PathBuf,
    /// What a person calls it: the path without its ending, `/` between folders.
    pub name: String,
    /// The scene.
    pub scene: Arc<Scene>,
    /// What holds for it.
    pub settings: Arc<Settings>,
    /// Its references, in the order in which they explain.
    pub parts: Vec<Part>,
}

/// What there is to check.
#[derive(Debug, Default)]
pub struct Found {
    /// The scenes, by name.
    pub jobs: Vec<Job>,
    /// References whose scene is gone, or that the settings no longer ask for, each with what to do.
    pub orphans: Vec<(PathBuf, String)>,
    /// Scenes on which the program failed by its own fault.
    pub faults: Vec<(PathBuf, SceneError)>,
}

/// The references of a scene or figure: `base` with the endings that the settings ask for.
pub fn parts(base: &Path, settings: &Settings) -> Vec<Part> {
    let mut parts = Vec::new();
    let has = |layer: Layer| settings.layers.contains(&layer);
    let named = |marks: &[String], ending: &str| {
        let mut name = base.file_name().unwrap_or_default().to_os_string();
        for mark in marks {
            name.push(format!(".{mark}"));
        }
        name.push(format!(".{ending}"));
        base.with_file_name(name)
    };
    let first_theme = settings.themes.first().cloned().unwrap_or_default();
    let part = |layer, file, kind, theme: &str, width| Part {
        layer,
        file,
        kind,
        theme: theme.to_owned(),
        width,
    };
    if has(Layer::Facts) {
        parts.push(part(
            Layer::Facts,
            named(&[], "txt"),
            Kind::Forces,
            &first_theme,
            None,
        ));
    }
    for (k, kind) in settings.kinds.iter().enumerate() {
        let kind_mark = (k > 0).then(|| kind.name().to_owned());
        if has(Layer::Svg) {
            let marks: Vec<String> = kind_mark.iter().cloned().collect();
            parts.push(part(
                Layer::Svg,
                named(&marks, "svg"),
                *kind,
                &first_theme,
                None,
            ));
        }
        if !has(Layer::Pixels) {
            continue;
        }
        for (t, theme) in settings.themes.iter().enumerate() {
            let theme_mark = (t > 0).then(|| theme.clone());
            let widths: Vec<Option<u32>> = match settings.widths.as_slice() {
                [] => vec![None],
                some => some.iter().copied().map(Some).collect(),
            };
            for (w, width) in widths.into_iter().enumerate() {
                let width_mark = width.filter(|_| w > 0).map(|w| format!("w{w}"));
                let marks: Vec<String> = [&kind_mark, &theme_mark, &width_mark]
                    .into_iter()
                    .flatten()
                    .cloned()
                    .collect();
                parts.push(part(
                    Layer::Pixels,
                    named(&marks, "png"),
                    *kind,
                    theme,
                    width,
                ));
            }
        }
    }
    parts
}

/// Every scene under some folders, and every reference that has none. A path to a scene file stands for itself.
///
/// A scene is a `.json` file that has the key `"drystone"`, in a folder that is neither hidden nor a cache. `only` leaves those
/// whose name contains it, or fits it where it has a `*`; where it is a scene's whole name, that scene alone: what is accepted
/// of `arch` must not take `arch2` with it.
///
/// # Errors
/// Everything that is wrong with any of them.
pub fn discover(places: &[PathBuf], only: Option<&str>) -> Result<Found, Vec<DiscoveryError>> {
    let mut search = Search::default();
    for place in places {
        match fs::metadata(place) {
            Ok(data) if data.is_dir() => search.folder(place),
            Ok(_) => search.scene(place.clone(), place.with_extension("")),
            Err(error) => search.unread(place, &error),
        }
    }
    let is_whole = |filter: &str| {
        let mut names = search.candidates.iter().map(|(_, base)| shown(base));
        names.any(|name| name == filter)
    };
    let whole = only.filter(|filter| is_whole(filter)).map(str::to_owned);
    let wanted = |name: &str| match only {
        None => true,
        Some(_) if whole.is_some() => {
            // Its references have an ending more.
            let rest = whole
                .as_ref()
                .and_then(|whole| name.strip_prefix(whole.as_str()));
            rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
        }
        Some(filter) if filter.contains('*') => fits(filter, name),
        Some(filter) => name.contains(filter),
    };
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
        // Those that are not wanted this time have their references too.
        for part in &parts {
            search.claim(&path, &part.file, &mut expected);
        }
        let name = shown(&base);
        if !wanted(&name) {
            continue;
        }
        let read = match isolate(&shown(&path), || Scene::from_slice(&bytes)) {
            Ok(read) => read,
            Err(fault) => {
                faults.push((path, fault));
                continue;
            }
        };
        match read {
            Ok(scene) => jobs.push(Job {
                path,
                name,
                scene: Arc::new(scene),
                settings,
                parts,
            }),
            Err(problems) => search.faults.push(DiscoveryError::Scene { path, problems }),
        }
    }
    if !search.faults.is_empty() {
        return Err(search.faults);
    }
    let orphans = search.orphans(&expected);
    let orphans = orphans.into_iter().filter(|(path, _)| wanted(&shown(path)));
    Ok(Found {
        orphans: orphans.collect(),
        jobs,
        faults,
    })
}

/// A path as a person reads it, the same on every system.
pub(super) fn shown(path: &Path) -> String {
    let shown = path.to_string_lossy().replace('\\', "/");
    shown.strip_prefix("./").unwrap_or(&shown).to_owned()
}

#[derive(Default)]
struct Search {
    /// Scenes, and where their references begin.
    candidates: Vec<(PathBuf, PathBuf)>,
    /// Everything else that could be a reference.
    others: Vec<PathBuf>,
    /// Settings by the file they come from, `None` for the default.
    known: BTreeMap<Option<PathBuf>, Option<Arc<Settings>>>,
    faults: Vec<DiscoveryError>,
}

impl Search {
    fn unread(&mut self, path: &Path, error: &std::io::Error) {
        self.faults.push(DiscoveryError::Unread {
            path: path.to_owned(),
            why: error.to_string(),
        });
    }

    fn folder(&mut self, folder: &Path) {
        let entries: Result<Vec<_>, _> = fs::read_dir(folder).and_then(Iterator::collect);
        let mut entries: Vec<fs::DirEntry> = match entries {
            Ok(entries) => entries,
            Err(error) => return self.unread(folder, &error),
        };
        entries.sort_by_key(fs::DirEntry::file_name);
        if entries.iter().any(|e| e.file_name() == "CACHEDIR.TAG") {
            return;
        }
        for entry in entries {
            let path = entry.path();
            let name = entry.file_name().to_string_lossy().into_owned();
            // A link to a folder may lead back up.
            let is_folder = entry.file_type().is_ok_and(|t| t.is_dir());
            match path
                .extension()
                .map(|e| e.to_string_lossy().to_ascii_lowercase())
                .as_deref()
            {
                _ if name.starts_with('.') || name == "node_modules" => {}
                _ if is_folder => self.folder(&path),
                _ if name == FILE => self.elsewhere(folder),
                Some("json") => self.scene(path.clone(), path.with_extension("")),
                Some("txt" | "svg" | "png") if !store::is_beside(&name) => self.others.push(path),
                _ => {}
            }
        }
    }

    /// The scenes that a settings file names beside those in its folder.
    fn elsewhere(&mut self, folder: &Path) {
        let Some(settings) = self.settings_of(folder) else {
            return;
        };
        for place in &settings.scenes {
            let place = folder.join(place);
            match fs::metadata(&place) {
                Ok(data) if data.is_dir() => {
                    let mut there = Search::default();
                    there.folder(&place);
                    for (path, _) in there.candidates {
                        let name = path.file_stem().unwrap_or_default().to_owned();
                        self.scene(path, folder.join(name));
                    }
                    self.faults.extend(there.faults);
                }
                Ok(_) => {
                    let name = place.file_stem().unwrap_or_default().to_owned();
                    self.scene(place, folder.join(name));
                }
                Err(error) => self.unread(&place, &error),
            }
        }
    }

    fn scene(&mut self, path: PathBuf, base: PathBuf) {
        self.candidates.push((path, base));
    }

    /// What holds in a folder. `None` where that is wrong, which has been reported then.
    fn settings_of(&mut self, folder: &Path) -> Option<Arc<Settings>> {
        let folder = if folder.as_os_str().is_empty() {
            Path::new(".")
        } else {
            folder
        };
        let file = setting::nearest(folder);
        if let Some(known) = self.known.get(&file) {
            return known.clone();
        }
        let read = match &file {
            None => Some(Settings::default()),
            Some(path) => match fs::read_to_string(path) {
                Err(error) => {
                    self.unread(path, &error);
                    None
                }
                Ok(text) => Settings::read(&text)
                    .map_err(|problems| {
                        let described =
                            problems
                                .into_iter()
                                .map(|problem| DiscoveryError::Settings {
                                    path: path.clone(),
                                    problem,
                                });
                        self.faults.extend(described);
                    })
                    .ok(),
            },
        };
        let settings = read.map(Arc::new);
        self.known.insert(file, settings.clone());
        settings
    }

    /// Two snapshots may not have a reference in common, not even on a file system that does not tell capitals.
    fn claim(&mut self, scene: &Path, file: &Path, expected: &mut BTreeMap<PathBuf, PathBuf>) {
        let folded = PathBuf::from(file.to_string_lossy().to_lowercase());
        if let Some(other) = expected.insert(folded, scene.to_owned())
            && other != scene
        {
            self.faults.push(DiscoveryError::Clash(format!(
                "{} and {} would both have the reference {} where capitals and small letters are one; rename one of them",
                shown(&other),
                shown(scene),
                shown(file)
            )));
        }
    }

    /// The bytes of a file that is a scene of ours.
    fn scene_bytes(
        &mut self,
        path: &Path,
        base: &Path,
        settings: &Settings,
        parts: &[Part],
    ) -> Option<Vec<u8>> {
        let below = setting::nearest(base.parent().unwrap_or(Path::new("."))).and_then(|file| {
            let folder = file.parent()?.to_owned();
            let path = std::path::absolute(path).ok()?;
            Some(shown(path.strip_prefix(folder).ok()?))
        });
        let ignored = |pattern: &String| below.as_deref().is_some_and(|below| fits(pattern, below));
        if settings.ignore.iter().any(ignored) {
            return None;
        }
        let bytes = match fs::read(path) {
            Ok(bytes) => bytes,
            Err(error) => {
                self.unread(path, &error);
                return None;
            }
        };
        let key = b"\"drystone\"";
        let is_scene = bytes.windows(key.len()).any(|w| w == key);
        // Another program's JSON is let be; a scene that lost its key is not, its references tell.
        (is_scene || parts.iter().any(|p| p.file.exists())).then_some(bytes)
    }

    /// Files that were written as references and are none any more.
    fn orphans(&self, expected: &BTreeMap<PathBuf, PathBuf>) -> Vec<(PathBuf, String)> {
        let fold = |path: &Path| PathBuf::from(path.to_string_lossy().to_lowercase());
        let mut stems: BTreeSet<PathBuf> = BTreeSet::new();
        for file in expected.keys() {
            stems.insert(file.with_extension(""));
        }
        // What tells of itself that it was made for a scene; and its neighbours of the same name.
        let described: Vec<&PathBuf> = self.others.iter().filter(|p| tells(p)).collect();
        let mut orphans = Vec::new();
        for path in &self.others {
            if expected.contains_key(&fold(path)) {
                continue;
            }
            let stem = path.with_extension("");
            let beside = described.iter().any(|t| t.with_extension("") == stem);
            let of_a_scene = stems.iter().any(|s| {
                let (own, s) = (
                    fold(&stem).to_string_lossy().into_owned(),
                    s.to_string_lossy(),
                );
                own.strip_prefix(s.as_ref())
                    .is_some_and(|rest| rest.starts_with('.'))
            });
            if beside || of_a_scene {
                let words = if of_a_scene {
                    "its scene has no such reference; the settings may have changed. Delete it"
                } else {
                    "its scene is gone. Delete it, or bring the scene back"
                };
                orphans.push((path.clone(), words.to_owned()));
            }
        }
        orphans
    }
}

/// Whether a file says of itself that it is the reference of a scene.
fn tells(path: &Path) -> bool {
    use std::io::Read;
    let mut head = Vec::new();
    let read = fs::File::open(path).and_then(|file| file.take(4096).read_to_end(&mut head));
    let marks: [&[u8]; 2] = [b"drystone facts ", b"drystone-snapshot\0scene"];
    read.is_ok()
        && (head.starts_with(marks[0]) || head.windows(marks[1].len()).any(|w| w == marks[1]))
}
