//! Two example scenes, which the command `drystone new` writes and which users can extend.

/// Returns a small example as the text of a scene file. Its structure stands after every step. Users can extend it.
///
/// ```
/// let scene = drystone::scene::Scene::from_json(drystone::scene::starter())?;
/// assert!(scene.frames().len() > 1);
/// # Ok::<(), drystone::scene::SceneError>(())
/// ```
pub fn starter() -> &'static str {
    include_str!("../../../assets/starter.json")
}

/// Returns the example of [`starter`] with one more step, in which a block tips over because a robot releases it too
/// early.
///
/// ```
/// let scene = drystone::scene::Scene::from_json(drystone::scene::falling_starter())?;
/// assert_eq!(drystone::Analysis::new(&scene).verdict(), drystone::analysis::Verdict::Unstable);
/// # Ok::<(), drystone::scene::SceneError>(())
/// ```
pub fn falling_starter() -> &'static str {
    include_str!("../../../assets/starter-falls.json")
}
