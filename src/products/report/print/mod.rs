//! Writes a report as PDF: A4 pages with figures, links, bookmarks and tagged text.
//!
//! A [`Flow`] places parts on pages from top to bottom. A page is a drawing with figures on it. The groups of the
//! drawing have roles, such as heading or table cell. Tables break between rows and repeat their column heads. Figures
//! are scaled down if they do not fit, and are never cut.

mod bar;
mod flow;
mod table;

use flow::{Flow, HEADING_HEIGHT, MARGIN, PAGE_SIZE, SMALL_TEXT_SIZE};

use super::entry::{Entry, SheetPart, overview};
use super::head::{Head, ReportError, STANDS_MEANING};
use crate::pictures::drawing::{Anchor, Drawing, Face, Group, PagePoint, PageRect, Text, Theme};
use crate::pictures::output::pdf::{self, Bookmark, Content, Heading, Inset, Link, Role, Sheet};
use crate::text::line;

/// A section begins below the rest of the section before if this rest is lower than this, pixels.
const MAX_REST: f64 = 80.0;

/// A section with a title begins on a page with at least this much space, pixels.
const MIN_SECTION: f64 = 150.0;

/// A page: a drawing of groups with roles, figures at positions, links to scenes and bookmarks.
#[derive(Clone, Debug, Default)]
pub(super) struct Page {
    groups: Vec<Group>,
    /// The role of each group.
    roles: Vec<Role>,
    /// Figures. Each has its drawing, its upper left corner and its scale.
    figures: Vec<(Drawing, PagePoint, f64)>,
    /// Charts and small pictures. Each has its SVG, its description, its upper left corner and its scale.
    charts: Vec<(String, String, PagePoint, f64)>,
    /// Links. Each has its area, the number of the scene to which it leads, from 1, and its text.
    links: Vec<(PageRect, usize, String)>,
    /// Headings for the list of bookmarks. Each has its level, its title and its position from the top of the page.
    bookmarks: Vec<(u8, String, f64)>,
    /// The line at the foot of the page.
    foot: String,
}

/// Makes the pages before the scenes: title, summary, invalid files and contents. `numbers` has the page on which each
/// scene begins, counted from 1.
pub(super) fn head(head: &Head<'_>, numbers: &[usize]) -> Vec<Page> {
    let mut flow = Flow::new(String::new());
    flow.heading(head.title, 24.0, 1);
    flow.paragraph(&format!("{}.", head.summary));
    flow.note(STANDS_MEANING);
    for note in head.notes {
        flow.note(note);
    }
    if !head.refused.is_empty() {
        flow.heading("Files that are not valid scenes", 16.0, 2);
        for file in head.refused {
            flow.strong(&file.name);
            for line in file.lines() {
                flow.paragraph(&line);
            }
        }
    }
    if head.rows.len() > 1 {
        flow.heading("Contents", 16.0, 2);
        flow.grid(&overview(&head.rows, head.compares, Some(numbers)));
    }
    flow.pages
}

/// Makes the pages of a scene.
pub(super) fn section(entry: &Entry) -> Vec<Page> {
    let mut flow = Flow::new(foot(entry));
    let row = &entry.row;
    let title = format!("{}: {}", row.title, row.verdict_words());
    flow.title(&title, &entry.details);
    for (number, section) in entry.sections.iter().enumerate() {
        if section.begins_page {
            // A few lines that did not fit on the page before do not need a page of their own.
            flow.flush();
            if flow.y > MARGIN + MAX_REST {
                flow.new_page();
            }
        } else if number > 0 && !section.title.is_empty() {
            flow.flush();
            flow.reserve(MIN_SECTION);
        }
        match (section.letter.as_str(), section.title.as_str()) {
            ("", "") => {}
            ("", title) => flow.heading(title, 16.0, 3),
            (letter, title) => {
                let words = format!("({letter}) {title}: {}", section.verdict.plain());
                flow.heading(&words, 16.0, 3);
            }
        }
        parts(&mut flow, &section.parts);
    }
    flow.flush();
    flow.pages
}

/// Returns the line at the foot of every page: the version of drystone, a hash of the scene file, and its name without
/// folders. A comparison has two hashes and two names.
fn foot(entry: &Entry) -> String {
    let names = entry.row.name.split(" → ");
    let names = names.map(|name| name.rsplit(['/', '\\']).next().unwrap_or(name));
    format!("{}, {}", entry.origin, names.collect::<Vec<_>>().join(" → "))
}

fn parts(flow: &mut Flow, parts: &[SheetPart]) {
    for (number, part) in parts.iter().enumerate() {
        // Keep a heading on the same page as the table below it, or at least as the first rows of this table.
        if let (SheetPart::Heading(_), Some(SheetPart::Table(grid))) = (part, parts.get(number + 1)) {
            flow.reserve(HEADING_HEIGHT + flow.least(grid));
        }
        match part {
            SheetPart::Badge(badge) => flow.badge(badge),
            SheetPart::Heading(words) => flow.heading(words, 13.0, 4),
            SheetPart::Text(words) => flow.paragraph(words),
            SheetPart::Note(words) => flow.note(words),
            SheetPart::Figures(figures) => flow.figures(figures),
            SheetPart::Table(grid) => flow.grid(grid),
            SheetPart::Columns(columns) => flow.columns(columns, &self::parts),
            SheetPart::Charts(charts) => flow.charts(charts),
        }
    }
}

/// Numbers the pages and writes them as PDF. `starts` has the index of the page on which each scene begins, from 0.
pub(super) fn written(
    pages: &mut [Page],
    title: &str,
    description: &str,
    starts: &[usize],
) -> Result<Vec<u8>, ReportError> {
    let count = pages.len();
    let title = line(title);
    let mut words = Vec::with_capacity(count);
    for (number, page) in pages.iter_mut().enumerate() {
        words.push(drawing(page, (number, count), &title));
    }
    let mut sheets = Vec::with_capacity(count);
    for (page, words) in pages.iter().zip(&words) {
        sheets.push(sheet(page, words, starts));
    }
    let bookmarks: Vec<Bookmark> = pages
        .iter()
        .enumerate()
        .flat_map(|(number, page)| {
            page.bookmarks.iter().map(move |(level, title, y)| Bookmark {
                level: *level,
                title: title.clone(),
                page: number,
                y: *y,
            })
        })
        .collect();
    let heading = Heading { title: &title, description };
    Ok(pdf::write_sheets(&sheets, &heading, &bookmarks)?)
}

/// Returns the drawing of a page with the line at its foot. `number` is the index of the page, from 0, and `count` is
/// the number of pages.
fn drawing(page: &mut Page, (number, count): (usize, usize), title: &str) -> Drawing {
    let theme = Theme::thesis();
    let y = PAGE_SIZE.1 - MARGIN + 12.0;
    let at = |x: f64| PagePoint::new(x, y);
    let words = format!("{} of {count}", number + 1);
    let words = Text::new(at(PAGE_SIZE.0 - MARGIN), words, Face::Sans, SMALL_TEXT_SIZE, theme.faint);
    let origin = Text::new(at(MARGIN), page.foot.clone(), Face::Sans, SMALL_TEXT_SIZE, theme.faint);
    page.roles.push(Role::Artifact);
    let mut groups = std::mem::take(&mut page.groups);
    groups.push(Group::default().with(origin).with(words.anchored(Anchor::End)));
    for (number, group) in groups.iter_mut().enumerate() {
        group.id = Some(format!("e{number}"));
    }
    Drawing {
        width: PAGE_SIZE.0,
        height: PAGE_SIZE.1,
        title: title.to_owned(),
        description: String::new(),
        background: None,
        items: groups.into_iter().map(Into::into).collect(),
    }
}

fn sheet<'p>(page: &'p Page, words: &'p Drawing, starts: &[usize]) -> Sheet<'p> {
    let mut parts =
        vec![Inset { content: Content::Tagged(words, &page.roles), at: PagePoint::new(0.0, 0.0), scale: 1.0 }];
    parts.extend(page.figures.iter().map(|(drawing, at, scale)| Inset {
        content: Content::Drawing(drawing),
        at: *at,
        scale: *scale,
    }));
    parts.extend(page.charts.iter().map(|(svg, shows, at, scale)| Inset {
        content: Content::Svg(svg, shows),
        at: *at,
        scale: *scale,
    }));
    let links = page.links.iter().filter_map(|(place, scene, words)| {
        Some(Link { place: *place, page: *starts.get(scene - 1)?, words: words.clone() })
    });
    Sheet { width: PAGE_SIZE.0, height: PAGE_SIZE.1, parts, links: links.collect() }
}
