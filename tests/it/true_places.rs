//! Every force of a joint is drawn at its own joint, in every scene of the tests and the assets.

use drystone::Analysis;
use drystone::analysis::Contact;
use drystone::drawing::{Camera, Drawing, Group, Item, PagePoint};
use drystone::figure::{self, Kind, Options};
use drystone::scene::{BodyId, Scene};

use crate::labels::classes;

/// Largest distance of a mark from the point where its force acts: 1.2 mm on a page with 96 pixels per inch.
const MOST: f64 = 1.2 * 96.0 / 25.4;
/// The width of a column of print, 84 mm, pixels.
const COLUMN: f64 = 84.0 * 96.0 / 25.4;

fn scenes() -> Vec<(String, Scene)> {
    let mut scenes = Vec::new();
    for folder in ["tests/scenes", "assets/gallery", "assets/thesis", "assets/study"] {
        let full = format!("{}/{folder}", env!("CARGO_MANIFEST_DIR"));
        for entry in std::fs::read_dir(full).expect("the folder is there") {
            let path = entry.expect("an entry").path();
            if path.extension().is_some_and(|end| end == "json") {
                let text = std::fs::read_to_string(&path).expect("the scene is there");
                scenes.extend(Scene::from_json(&text).ok().map(|scene| (path.display().to_string(), scene)));
            }
        }
    }
    scenes.sort_by(|a, b| a.0.cmp(&b.0));
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
    let [a, b] = contact.interface.bodies.map(|body| match body {
        BodyId::Ground(_) => "the ground".to_owned(),
        BodyId::Block(block) => format!("block {}", scene.blocks()[block.0].id),
    });
    let (ab, ba) = ([&a, &b], [&b, &a]);
    [ab, ba].iter().any(|[one, other]| {
        title.starts_with(&format!("Force on {one} from {other}:"))
            || title.starts_with(&format!("Force between {one} and {other}:"))
    })
}

/// Checks the marks of all joints of a drawing, and returns their number.
fn check(name: &str, analysis: &Analysis, drawing: &Drawing) -> usize {
    let scene = &analysis.scene;
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

#[test]
fn no_mark_of_a_force_lies_beside_its_own_joint() {
    let mut count = 0;
    for (name, scene) in scenes() {
        let analysis = Analysis::new(&scene);
        for options in [Options::default(), Options::default().width(COLUMN)] {
            count += check(&name, &analysis, &figure::draw(&analysis, Kind::Forces, &options));
        }
    }
    assert!(count > 2000, "only {count} marks");
}
