//! [`DrawnBoxes`]: tests whether a label lies inside the ground or a block that the label does not name. A reader
//! would mistake the label for the name of this body.

use super::middle;
use crate::geometry::Bounds;
use crate::mechanics::scene::BlockId;
use crate::pictures::drawing::PageRect;
use crate::products::figure::pen::Pen;

/// The bounding boxes on the page of the blocks of a frame, as they are drawn, and of the ground.
pub(super) struct DrawnBoxes {
    blocks: Vec<(BlockId, PageRect)>,
    ground: Vec<(usize, PageRect)>,
}

impl DrawnBoxes {
    pub(super) fn new(pen: &Pen<'_>) -> DrawnBoxes {
        let scene = &pen.context.analysis.scene;
        let drawn = |id: &BlockId| {
            let corners = scene.blocks[id.0].body.polygon.rings().first();
            let corners = corners.into_iter().flatten();
            let bounds = Bounds::from_points(corners.map(|p| pen.moved(*id, *p)))?;
            Some((*id, pen.camera.rect(bounds)))
        };
        let ground = scene.ground.iter().enumerate();
        DrawnBoxes {
            blocks: scene.frames[pen.number].placed.iter().filter_map(drawn).collect(),
            ground: ground.map(|(i, g)| (i, pen.camera.rect(g.body.polygon.bounds()))).collect(),
        }
    }

    /// True if a label with the rectangle `rect` lies in the ground or in a block other than `own`. The label names
    /// the block `own`.
    pub(super) fn other(&self, pen: &Pen<'_>, own: BlockId, rect: PageRect) -> bool {
        let scene = &pen.context.analysis.scene;
        let met = |other: &PageRect| {
            rect.at.x < other.at.x + other.width
                && other.at.x < rect.at.x + rect.width
                && rect.at.y < other.at.y + other.height
                && other.at.y < rect.at.y + rect.height
        };
        // A label does not cross outlines. If it overlaps a body, its centre therefore lies in this body.
        let at = pen.camera.back(middle(rect));
        let inside = |id: BlockId| {
            let at = pen.displacement(id).map_or(at, |d| d.back(at));
            scene.blocks[id.0].body.polygon.contains(at)
        };
        let mut blocks = self.blocks.iter().filter(|b| b.0 != own && met(&b.1));
        let mut ground = self.ground.iter().filter(|g| met(&g.1));
        blocks.any(|b| inside(b.0)) || ground.any(|g| scene.ground[g.0].body.polygon.contains(at))
    }
}
