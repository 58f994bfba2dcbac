//! The first example of a scene.

/// A small scene to build on that stands in every step, as the text of a scene file.
///
/// ```
/// let scene = drystone::scene::Scene::from_json(drystone::scene::starter())?;
/// assert!(scene.frames().len() > 1);
/// # Ok::<(), drystone::scene::SceneError>(())
/// ```
pub fn starter() -> &'static str {
    include_str!("../../../assets/starter.json")
}

/// The same scene with one more step, in which a block tips over because the robot lets go too early.
///
/// ```
/// let scene = drystone::scene::Scene::from_json(drystone::scene::falling_starter())?;
/// assert_eq!(drystone::Analysis::new(&scene).verdict(), drystone::analysis::Verdict::Unstable);
/// # Ok::<(), drystone::scene::SceneError>(())
/// ```
pub fn falling_starter() -> &'static str {
    include_str!("../../../assets/starter-falls.json")
}
