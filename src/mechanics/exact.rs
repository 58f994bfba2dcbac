//! [`Analysis::exact`]: an analysis at the accuracy that its options name, with what exact arithmetic says of it.

use std::sync::Arc;

use super::analysis::{Accuracy, Analysis, INEXACT, Options, UndecidedReason, Verdict};
#[cfg(feature = "certificate")]
use super::certificate::Certificate;
use super::scene::Scene;

impl Analysis {
    /// Analyses every frame of a scene as [`Analysis::with`] does. At the accuracies [`Proved`](Accuracy::Proved) and
    /// [`Exact`](Accuracy::Exact), each frame also says whether exact arithmetic proves its verdict, in every load case and
    /// at every position of a vehicle. At `Exact`, a frame whose verdict it does not prove is undecided; without the feature
    /// `certificate`, every frame is.
    ///
    /// # Example
    /// ```
    /// use drystone::{Analysis, Scene, analysis::{Accuracy, Options, Verdict}, starter::Tower};
    /// let options = Options::default().accuracy(Accuracy::Exact);
    /// let analysis = Analysis::exact(Scene::new(Tower::default().scene())?, &options);
    /// # #[cfg(feature = "certificate")]
    /// assert_eq!((analysis.verdict(), analysis.frames[0].exact), (Verdict::Stable, Some(true)));
    /// # Ok::<(), drystone::scene::SceneError>(())
    /// ```
    pub fn exact(scene: impl Into<Arc<Scene>>, options: &Options) -> Analysis {
        let mut analysis = Analysis::with(scene, options);
        #[cfg(feature = "certificate")]
        if options.accuracy != Accuracy::Standard {
            Certificate::note_exact(&mut analysis, options);
        }
        if options.accuracy == Accuracy::Exact {
            analysis.change_each(|_, _, found| {
                if found.verdict != Verdict::Undecided && found.exact != Some(true) {
                    let found = Arc::make_mut(found);
                    // The reason takes the place of the notice.
                    let notice = found.notices.iter().position(|notice| notice.starts_with(INEXACT));
                    let fault = notice.map(|at| found.notices.remove(at).split_off(INEXACT.len()));
                    let fault = fault.unwrap_or_else(|| "this build has no exact arithmetic".to_owned());
                    found.leave_undecided(UndecidedReason::Inexact { verdict: found.verdict, fault });
                }
            });
        }
        analysis
    }
}
