//! [`beside`]: several drawings on one page.

use super::{Drawing, Group, Item, Outline, PagePoint, Segment};

/// Drawings next to each other, their upper edges level, `gap` pixels apart; an empty page where there is none.
///
/// Names of groups get the drawing's number in front, so that each stays the only one of its name.
pub fn beside(drawings: Vec<Drawing>, gap: f64) -> Drawing {
    let mut page = Drawing {
        width: 0.0,
        height: 0.0,
        title: String::new(),
        description: String::new(),
        background: None,
        items: Vec::new(),
    };
    for (number, drawing) in drawings.into_iter().enumerate() {
        let right = if number > 0 { page.width + gap } else { 0.0 };
        page.width = right + drawing.width;
        page.height = page.height.max(drawing.height);
        if number == 0 {
            page.title = drawing.title;
            page.background = drawing.background;
        } else {
            page.description.push(' ');
        }
        page.description.push_str(&drawing.description);
        let mark = format!("{}-", number + 1);
        let moved = |item| moved(item, right, &mark);
        page.items.extend(drawing.items.into_iter().map(moved));
    }
    page
}

fn moved(item: Item, right: f64, mark: &str) -> Item {
    let at = |p: PagePoint| p.moved(right, 0.0);
    match item {
        Item::Path(mut path) => {
            let step = |segment: &Segment| match *segment {
                Segment::Move(p) => Segment::Move(at(p)),
                Segment::Line(p) => Segment::Line(at(p)),
                Segment::Curve(a, b, c) => Segment::Curve(at(a), at(b), at(c)),
                Segment::Close => Segment::Close,
            };
            path.outline = Outline {
                segments: path.outline.segments.iter().map(step).collect(),
            };
            Item::Path(path)
        }
        Item::Text(mut text) => {
            text.at = at(text.at);
            Item::Text(text)
        }
        Item::Group(mut group) => {
            group.id = group.id.map(|id| format!("{mark}{id}"));
            if let Some(clip) = &mut group.clip {
                clip.at = at(clip.at);
            }
            group.camera = group.camera.map(|camera| camera.moved(right, 0.0));
            let items = std::mem::take(&mut group.items);
            Item::Group(Group {
                items: items.into_iter().map(|i| moved(i, right, mark)).collect(),
                ..group
            })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Colour, Path};
    use super::*;

    #[test]
    fn everything_of_the_second_moves_and_names_stay_apart() {
        let one = |width: f64, height: f64| {
            let dot = Outline::circle(PagePoint::new(4.0, 5.0), 1.0);
            let mut group = Group::of_class("dot").with(Path::filled(dot, Colour::BLACK));
            group.id = Some("dot".to_owned());
            Drawing {
                width,
                height,
                title: format!("{width}"),
                description: "A dot.".to_owned(),
                background: Some(Colour::WHITE),
                items: vec![group.into()],
            }
        };
        let page = beside(vec![one(30.0, 10.0), one(20.0, 40.0)], 7.0);
        assert_eq!(
            (page.width, page.height, page.title.as_str()),
            (57.0, 40.0, "30")
        );
        assert_eq!(page.description, "A dot. A dot.");
        let groups: Vec<&Group> = page
            .items
            .iter()
            .map(|item| match item {
                Item::Group(group) => group,
                _ => unreachable!("both are groups"),
            })
            .collect();
        assert_eq!(groups[0].id.as_deref(), Some("1-dot"));
        assert_eq!(groups[1].id.as_deref(), Some("2-dot"));
        let Item::Path(path) = &groups[1].items[0] else {
            unreachable!("a dot")
        };
        assert!(path.outline.points().all(|p| (p.x - 41.0).abs() < 1.001));
    }
}
