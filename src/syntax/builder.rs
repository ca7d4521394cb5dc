//! From what the grammar read to the tree.
//!
//! A statement that has an unreadable value is left out whole: half of a statement would only lead to complaints about
//! what is missing in it. So the functions here return `None` for what has been reported already.

use super::ast::{ArcBy, Ast, Block, Curve, Entry, HeadPart, Item, Point, Relation, Row, SurfaceFile};
use super::bad::Bad;
use super::grammar::{Mismatch, Rule};
use super::mistakes;
use super::place::{Place, unquoted};
use super::reports::Reports;
use pest::iterators::{Pair, Pairs};
use std::ops::Range;
use vcutc_diagnostics::source::{FileId, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};

/// Makes a piece of a profile of a path and options.
type OfAFile = fn(Spanned<String>, Vec<Entry>) -> Curve;

/// What a piece of a profile that is a file becomes, by its rule or by its word.
fn of_a_file(rule: Rule) -> Option<OfAFile> {
    match rule {
        Rule::points | Rule::points_word => Some(|path, options| Curve::Points { path, options }),
        Rule::airfoil | Rule::airfoil_word => Some(|path, options| Curve::Airfoil { path, options }),
        Rule::dxf | Rule::dxf_word => Some(|path, options| Curve::Dxf { path, options }),
        Rule::svg | Rule::svg_word => Some(|path, options| Curve::Svg { path, options }),
        _ => None,
    }
}

/// Builds the tree of one text.
#[derive(Debug)]
pub(super) struct Builder<'t> {
    pub(super) place: Place,
    text: &'t str,
    /// In order and apart from one another.
    doubtful: Vec<Range<usize>>,
    pub(super) reports: Reports,
    /// Where the statement before ended.
    last_end: usize,
}

impl<'t> Builder<'t> {
    pub(super) fn new(
        file: FileId,
        offset: u32,
        text: &'t str,
        doubtful: Vec<Range<usize>>,
        reports: Reports,
    ) -> Self {
        Self {
            place: Place {
                file,
                offset: offset as usize,
                length: text.len(),
            },
            text,
            doubtful: joined(doubtful),
            reports,
            last_end: 0,
        }
    }

    /// Everything that is wrong.
    pub(super) fn finish(self) -> Vec<Diagnostic> {
        self.reports.finish()
    }

    pub(super) fn file(&mut self, mut pairs: Pairs<'_, Rule>) -> Ast {
        let mut items = Vec::new();
        for pair in pairs.next().into_iter().flat_map(Pair::into_inner) {
            let end = pair.as_span().end();
            items.extend(self.item(pair));
            self.last_end = end;
        }
        Ast { items }
    }

    pub(super) fn only_expression(
        &mut self,
        mut pairs: Pairs<'_, Rule>,
    ) -> Option<Spanned<super::ast::Expr>> {
        let value = find(pairs.next()?, Rule::expression)?;
        self.value(value)
    }

    fn item(&mut self, pair: Pair<'_, Rule>) -> Option<Item> {
        let span = self.place.span_of(&pair);
        match pair.as_rule() {
            Rule::job => {
                let name = self.place.text(&find(pair, Rule::text)?);
                Some(Item::Job { name, span })
            }
            Rule::use_file => {
                let path = self.place.text(&find(pair, Rule::text)?);
                Some(Item::Use { path, span })
            }
            Rule::let_value => {
                let (name, value) = self.name_and_value(pair)?;
                Some(Item::Let { name, value, span })
            }
            Rule::block => self.block(pair).map(Item::Block),
            Rule::file_profile => self.file_profile(pair).map(Item::Block),
            Rule::bad_item => {
                self.bad(&pair, Rule::only_item);
                None
            }
            _ => None,
        }
    }

    fn name_and_value(
        &mut self,
        pair: Pair<'_, Rule>,
    ) -> Option<(Spanned<String>, Spanned<super::ast::Expr>)> {
        let name = self.place.spanned(&find(pair.clone(), Rule::name)?);
        let value = self.value(find(pair, Rule::expression)?)?;
        Some((name, value))
    }

    fn block(&mut self, pair: Pair<'_, Rule>) -> Option<Block> {
        let span = self.place.span_of(&pair);
        let mut parts = pair.into_inner();
        let head = parts
            .next()?
            .into_inner()
            .map(|part| self.head_part(&part))
            .collect();
        let entries = self.entries(parts);
        Some(Block { head, entries, span })
    }

    /// A profile in its short form, as the block that it abbreviates.
    fn file_profile(&mut self, pair: Pair<'_, Rule>) -> Option<Block> {
        let span = self.place.span_of(&pair);
        let word = find(pair.clone(), Rule::profile_word)?;
        let head = vec![Spanned::new(
            HeadPart::Word(word.as_str().to_owned()),
            self.place.span_of(&word),
        )];
        let piece = find(pair.clone(), Rule::file_piece)?;
        let start = self.place.span_of(&piece);
        let path = self.place.text(&find(pair.clone(), Rule::text)?);
        let mut options = Vec::new();
        for option in find(pair, Rule::file_options)?.into_inner() {
            let span = self.place.span_of(&option);
            if option.as_rule() == Rule::file_option {
                let (name, value) = self.name_and_value(option)?;
                options.push(Entry::Field { name, value, span });
            }
        }
        let make = of_a_file(piece.into_inner().next()?.as_rule())?;
        let curve = Entry::Curve {
            curve: Box::new(make(path, options)),
            span: start.to(span),
        };
        Some(Block {
            head,
            entries: vec![curve],
            span,
        })
    }

    fn head_part(&self, pair: &Pair<'_, Rule>) -> Spanned<HeadPart> {
        let part = match pair.as_rule() {
            Rule::equals => HeadPart::Equals,
            Rule::text => HeadPart::Text(unquoted(pair.as_str())),
            _ => HeadPart::Word(pair.as_str().to_owned()),
        };
        Spanned::new(part, self.place.span_of(pair))
    }

    fn entries(&mut self, parts: Pairs<'_, Rule>) -> Vec<Entry> {
        let mut entries = Vec::new();
        for part in parts {
            let end = part.as_span().end();
            entries.extend(self.entry(part));
            self.last_end = end;
        }
        entries
    }

    /// An entry; `None` also for the braces and commas around entries.
    fn entry(&mut self, pair: Pair<'_, Rule>) -> Option<Entry> {
        let span = self.place.span_of(&pair);
        match pair.as_rule() {
            Rule::field => {
                let (name, value) = self.name_and_value(pair)?;
                Some(Entry::Field { name, value, span })
            }
            Rule::limit => self.limit(pair),
            Rule::formula => self.formula(pair),
            Rule::inner_block => self.block(pair).map(Entry::Block),
            Rule::row => self.row(pair),
            Rule::control_row => self.control_row(pair),
            Rule::surface_file => self.surface_file(pair),
            Rule::station => self.station(pair),
            Rule::bad_entry => {
                self.bad(&pair, Rule::only_entry);
                None
            }
            Rule::start
            | Rule::line
            | Rule::arc
            | Rule::bezier
            | Rule::spline
            | Rule::polyline
            | Rule::open_side
            | Rule::circle
            | Rule::points
            | Rule::airfoil
            | Rule::dxf
            | Rule::svg => {
                let curve = Box::new(self.curve(pair)?);
                Some(Entry::Curve { curve, span })
            }
            _ => None,
        }
    }

    fn limit(&mut self, pair: Pair<'_, Rule>) -> Option<Entry> {
        let span = self.place.span_of(&pair);
        let relation = pair.clone().into_inner().find_map(|part| {
            let relation = match part.as_rule() {
                Rule::at_most => Relation::AtMost,
                Rule::at_least => Relation::AtLeast,
                _ => return None,
            };
            Some(Spanned::new(relation, self.place.span_of(&part)))
        })?;
        let (name, value) = self.name_and_value(pair)?;
        Some(Entry::Limit {
            name,
            relation,
            value,
            span,
        })
    }

    fn formula(&mut self, pair: Pair<'_, Rule>) -> Option<Entry> {
        let span = self.place.span_of(&pair);
        let name = self.place.spanned(&find(pair.clone(), Rule::name)?);
        let variables = find(pair.clone(), Rule::variables)?.into_inner();
        let variables = variables.filter(|part| part.as_rule() == Rule::name);
        let variables = variables.map(|part| self.place.spanned(&part)).collect();
        let value = self.value(find(pair, Rule::expression)?)?;
        Some(Entry::Formula {
            name,
            variables,
            value,
            span,
        })
    }

    fn surface_file(&mut self, pair: Pair<'_, Rule>) -> Option<Entry> {
        let span = self.place.span_of(&pair);
        let word = self.place.spanned(&find(pair.clone(), Rule::surface_word)?);
        let kind = Spanned::new(SurfaceFile::named(&word.node)?, word.span);
        let path = self.place.text(&find(pair.clone(), Rule::text)?);
        Some(Entry::SurfaceFile {
            kind,
            path,
            options: self.options(pair),
            span,
        })
    }

    fn station(&mut self, pair: Pair<'_, Rule>) -> Option<Entry> {
        let span = self.place.span_of(&pair);
        let word = self.place.span_of(&find(pair.clone(), Rule::at_word)?);
        let at = self.value(find(pair.clone(), Rule::expression)?);
        // The pieces are read even if the place is wrong, so that all faults are reported.
        let entries = self.entries(pair.into_inner());
        Some(Entry::Station {
            word,
            at: at?,
            entries,
            span,
        })
    }

    /// The fields in braces after a file.
    fn options(&mut self, pair: Pair<'_, Rule>) -> Vec<Entry> {
        match find(pair, Rule::curve_options) {
            Some(options) => self.entries(options.into_inner()),
            None => Vec::new(),
        }
    }

    fn curve(&mut self, pair: Pair<'_, Rule>) -> Option<Curve> {
        let rule = pair.as_rule();
        if let Some(make) = of_a_file(rule) {
            let path = self.place.text(&find(pair.clone(), Rule::text)?);
            return Some(make(path, self.options(pair)));
        }
        let mut points = Vec::new();
        let mut by = None;
        for part in pair.into_inner() {
            match part.as_rule() {
                Rule::point => points.push(self.point(part)?),
                Rule::arc_radius | Rule::arc_center | Rule::arc_through => by = Some(self.arc_by(part)?),
                _ => {}
            }
        }
        let to = points.pop()?;
        match rule {
            Rule::start => Some(Curve::Start(to)),
            Rule::line => Some(Curve::Line { to }),
            Rule::arc => Some(Curve::Arc { to, by: by? }),
            Rule::bezier => Some(Curve::Bezier { control: points, to }),
            Rule::spline => Some(Curve::Spline { through: points, to }),
            Rule::polyline => Some(Curve::Polyline { through: points, to }),
            Rule::open_side => Some(Curve::Open { to }),
            Rule::circle => match by? {
                ArcBy::Radius(radius) => Some(Curve::Circle { center: to, radius }),
                ArcBy::Center(_) | ArcBy::Through(_) => None,
            },
            _ => None,
        }
    }

    fn row(&mut self, pair: Pair<'_, Rule>) -> Option<Entry> {
        let span = self.place.span_of(&pair);
        let word = self.place.spanned(&find(pair.clone(), Rule::row_word)?);
        let row = Spanned::new(Row::named(&word.node)?, word.span);
        let points = self.points(pair)?;
        Some(Entry::Row { row, points, span })
    }

    fn control_row(&mut self, pair: Pair<'_, Rule>) -> Option<Entry> {
        let span = self.place.span_of(&pair);
        let word = self.place.span_of(&find(pair.clone(), Rule::control_word)?);
        let groups = pair.into_inner().filter(|part| part.as_rule() == Rule::group);
        // All are read even if one is wrong, so that all are reported.
        let points: Vec<Option<_>> = groups.map(|group| self.group_value(group)).collect();
        let points = points.into_iter().collect::<Option<_>>()?;
        Some(Entry::ControlRow { word, points, span })
    }

    /// The points of a row of them. All are read even if one is wrong, so that all are reported.
    fn points(&mut self, pair: Pair<'_, Rule>) -> Option<Vec<Point>> {
        let rows = pair.into_inner().filter(|part| part.as_rule() == Rule::point);
        let points: Vec<Option<Point>> = rows.map(|row| self.point(row)).collect();
        points.into_iter().collect()
    }

    fn arc_by(&mut self, pair: Pair<'_, Rule>) -> Option<ArcBy> {
        match pair.as_rule() {
            Rule::arc_radius => self.value(find(pair, Rule::expression)?).map(ArcBy::Radius),
            Rule::arc_center => self.point(find(pair, Rule::point)?).map(ArcBy::Center),
            Rule::arc_through => self.point(find(pair, Rule::point)?).map(ArcBy::Through),
            _ => None,
        }
    }

    fn point(&mut self, pair: Pair<'_, Rule>) -> Option<Point> {
        let span = self.place.span_of(&pair);
        let mut values = pair
            .into_inner()
            .filter(|part| part.as_rule() == Rule::expression);
        let (first, second) = (values.next()?, values.next()?);
        // Both are read even if the first is wrong, so that both are reported.
        let (first, second) = (self.value(first), self.value(second));
        Some(Point {
            first: first?,
            second: second?,
            span,
        })
    }

    /// Reports a statement that cannot be read, unless a guess of ours may be the cause.
    fn bad(&mut self, pair: &Pair<'_, Rule>, rule: Rule) {
        let range = pair.as_span().start()..pair.as_span().end();
        if self.is_doubtful(&range) {
            return;
        }
        let bad = Bad {
            place: self.place,
            text: self.text,
            mended: pair.as_str(),
            start: range.start,
            previous_end: self.last_end,
        };
        self.reports.push_with(|| mistakes::explain(&bad, rule));
    }

    fn is_doubtful(&self, range: &Range<usize>) -> bool {
        let first = self
            .doubtful
            .partition_point(|doubtful| doubtful.end <= range.start);
        self.doubtful
            .get(first)
            .is_some_and(|doubtful| doubtful.start < range.end)
    }

    /// Reports a value that cannot be read from some place on.
    pub(super) fn bad_expression(&mut self, position: usize, expected: &[Rule]) {
        if !self.is_doubtful(&(0..self.text.len())) {
            let bad = Bad {
                place: self.place,
                text: self.text,
                mended: self.text,
                start: 0,
                previous_end: 0,
            };
            self.reports.push(mistakes::mismatch(&bad, position, expected));
        }
    }

    /// Reports a text that could not be read at all.
    pub(super) fn unreadable(&mut self, mismatch: &Mismatch) {
        let report = match mismatch {
            Mismatch::At { position, .. } => Diagnostic::new(
                Code::UnexpectedText,
                "this cannot be read",
                self.place.span(*position..*position),
                "from here on",
            ),
            Mismatch::TooMuchWork => Diagnostic::new(
                Code::NestedTooDeeply,
                "this file is too tangled to parse",
                self.place.span(0..self.text.len()),
                "the parser gave up on it",
            )
            .help("nest blocks and values less deeply"),
        };
        self.reports.push(report);
    }
}

/// The same stretches in order, those that touch made one.
fn joined(mut ranges: Vec<Range<usize>>) -> Vec<Range<usize>> {
    ranges.sort_by_key(|range| range.start);
    let mut joined: Vec<Range<usize>> = Vec::new();
    for range in ranges {
        match joined.last_mut() {
            Some(last) if range.start <= last.end => last.end = last.end.max(range.end),
            _ => joined.push(range),
        }
    }
    joined
}

/// The first part of a pair that is of a rule.
fn find<'t>(pair: Pair<'t, Rule>, rule: Rule) -> Option<Pair<'t, Rule>> {
    pair.into_inner().find(|part| part.as_rule() == rule)
}
