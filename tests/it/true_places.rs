//! Every force of a joint is drawn at its own joint, in every scene of the tests and the assets.

use drystone::Analysis;
use drystone::analysis::Contact;
use drystone::drawing::{Camera, Drawing, Group, Item, PagePoint, Theme};
use drystone::figure::{self, Kind, Options};
use drystone::scene::{BodyId, Scene};

use crate::labels::classes;

/// Largest distance of a mark from the point where its force acts: 1.2 mm on a page with 96 pixels per inch.
const MOST: f64 = 1.2 * 96.0 / 25.4;
/// The width of a column of print, 84 mm, pixels.
const COLUMN: f64 = 84.0 * 96.0 / 25.4;

/// The scenes of the tests, the assets and the examples with at most a thousand blocks; the marks of more blocks are
/// joined.
pub(crate) fn scenes() -> Vec<(String, Scene)> {
    let mut scenes = Vec::new();
    let mut folders = ["tests/scenes", "assets", "examples"]
        .map(|folder| std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(folder))
        .to_vec();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).expect("the folder is there") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|end| end == "json") {
                let text = std::fs::read_to_string(&path).expect("the scene is there");
                scenes.extend(Scene::from_json(&text).ok().map(|scene| (path.display().to_string(), scene)));
            }
        }
    }
    scenes.retain(|(_, scene)| scene.blocks().len() <= 1000);
    scenes.sort_by(|a, b| a.0.cmp(&b.0));
    assert!(scenes.len() > 80, "{}", scenes.len());
    scenes
}

fn camera(items: &[Item]) -> Option<Camera> {
    items.iter().find_map(|item| match item {
        Item::Group(group) => group.camera.or_else(|| camera(&group.items)),
        _ => None,
    })
}

/// The smallest distance of a point from the outlines of a mark, pixels.
fn distance(mark: &Group, p: PagePoint) -> f64 {
    let mut least = f64::INFINITY;
    for item in &mark.items {
        let Item::Path(path) = item else { continue };
        let points: Vec<PagePoint> = path.outline.points().collect();
        for (a, b) in points.iter().zip(points.iter().cycle().skip(1)) {
            let (x, y) = (b.x - a.x, b.y - a.y);
            let length = x * x + y * y;
            let share = if length > 0.0 { (((p.x - a.x) * x + (p.y - a.y) * y) / length).clamp(0.0, 1.0) } else { 0.0 };
            least = least.min(libm::hypot(p.x - a.x - share * x, p.y - a.y - share * y));
        }
    }
    least
}

/// True if the title of a mark names the two bodies of a contact.
fn names(title: &str, scene: &Scene, contact: &Contact) -> bool {
    let ids = contact.interface.bodies.map(|body| match body {
        BodyId::Ground(_) => None,
        BodyId::Block(block) => Some(&scene.blocks()[block.0].id),
    });
    let plain = ids.map(|id| id.map_or("the ground".to_owned(), String::clone));
    let [a, b] = ids.map(|id| id.map_or("the ground".to_owned(), |id| format!("block {id}")));
    [[0, 1], [1, 0]].iter().any(|[i, k]| title.starts_with(&format!("Force between {} and {}: ", plain[*i], plain[*k])))
        || [(&a, &b), (&b, &a)].iter().any(|(on, from)| title.starts_with(&format!("Force on {on} from {from}: ")))
}

/// Checks the marks of all joints of a drawing, and returns their number.
fn check(name: &str, analysis: &Analysis, drawing: &Drawing) -> usize {
    let scene = analysis.given();
    let mut count = 0;
    for (found, frame) in analysis.frames.iter().zip(classes(&drawing.items, &["frame"])) {
        let Some(camera) = camera(&frame.items) else { continue };
        for mark in classes(&frame.items, &["force"]) {
            let own = found.contacts.iter().filter(|contact| names(&mark.title, scene, contact));
            let far = own.map(|contact| distance(mark, camera.place(contact.resultant.at)));
            let Some(far) = far.reduce(f64::min) else { continue };
            assert!(far <= MOST, "{name}: {far} px beside its joint: {}", mark.title);
            count += 1;
        }
    }
    count
}

/// The look of most scenes, and of scenes on a lattice, by default, and both on request, on a screen and in print.
#[test]
fn no_mark_of_a_force_lies_beside_its_own_joint() {
    let mut count = 0;
    let looks = [
        Options::default(),
        Options::default().width(COLUMN),
        Options::default().theme(Theme::plain()).width(COLUMN),
        Options::default().theme(Theme::thesis()),
        Options::default().theme(Theme::thesis()).width(COLUMN),
    ];
    for (name, scene) in scenes() {
        let analysis = Analysis::new(&scene);
        for options in &looks {
            count += check(&name, &analysis, &figure::draw(&analysis, Kind::Forces, options));
        }
    }
    assert!(count > 8000, "only {count} marks");
}
