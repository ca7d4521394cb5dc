//! The tree of a file as a row of places, each with what is there.
//!
//! Every question about a place in a text is answered from this row: what is under the cursor, where a name is used, which
//! values can be hinted at. It is made from the tree alone; what names stand for is known by the study of the whole job.

use super::manual;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_job::sema::kind::Operations;
use vcutc_job::sema::vocabulary::{self, BlockSpec, FieldSpec, Leaving, RESERVED, Takes};
use vcutc_syntax::ast::{ArcBy, Argument, Ast, Block, Curve, Entry, Expr, HeadPart, Item, Point};

/// A place and what is there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Site<'a> {
    pub(super) span: Span,
    pub(super) kind: Kind<'a>,
    /// In which field of which block.
    pub(super) place: Place<'a>,
}

/// What is at a place.
#[derive(Clone, Copy, Debug)]
pub(super) enum Kind<'a> {
    /// The first word of a block's head, or the head of a block within another.
    Block,
    /// The word after `rough`, or the kind of a machine.
    HeadWord,
    /// The name of the job.
    JobName,
    /// A name that is defined here.
    Definition(Named, &'a str),
    /// A name that is used here, unless it is a word of a target.
    Reference(&'a str),
    /// The name of a field, a limit or an option.
    Field(&'a str),
    /// A word that the field takes.
    Word,
    /// `auto`.
    Auto,
    /// A number with what belongs to it.
    Number(&'a Spanned<Expr>),
    Unit(&'a str),
    /// A function, or another call.
    Function(&'a str),
    /// The name of a value in a call of that name.
    Label(&'a str),
    /// The name of a formula.
    Formula,
    /// The variable of a formula.
    Variable,
    /// A text that names a file, or a machine of the catalogue.
    Path(Path, &'a str),
    /// The whole value of a field or a `let`, or a coordinate of a point.
    Value(&'a Spanned<Expr>),
}

/// What a name is defined as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Named {
    Value,
    Blade,
    Region,
    Machine,
}

/// What a text in quotes names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Path {
    /// A file of definitions.
    Use,
    /// A file of points or an airfoil.
    Data,
    /// A model of the catalogue, or a file that describes one.
    Model,
    /// A file with a machine's habits.
    Profile,
}

/// The block and the field that something is in.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place<'a> {
    /// The block as the reference calls it: `rough vcut`, `limits`; empty outside of blocks.
    pub(super) block: &'a str,
    /// Which of the operations of the file it is, or belongs to.
    pub(super) operation: Option<usize>,
    pub(super) field: Option<&'static FieldSpec>,
    /// Whether bare words may be words of a target.
    pub(super) words: Words,
}

/// What a bare word is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Words {
    Names,
    /// A name if there is a `let` of that name, else a word of a target.
    OfTarget,
}

const NOWHERE: Place<'static> = Place {
    block: "",
    operation: None,
    field: None,
    words: Words::Names,
};

/// The places of a file, in the order of the text; a place within another comes after it.
pub(super) fn sites(ast: &Ast, operations: Operations) -> Vec<Site<'_>> {
    let mut row = Row {
        known: operations,
        ..Row::default()
    };
    for item in &ast.items {
        row.item(item);
    }
    row.sites
}

#[derive(Default)]
struct Row<'a> {
    sites: Vec<Site<'a>>,
    /// How many there are so far.
    operations: usize,
    known: Operations,
}

impl<'a> Row<'a> {
    fn push(&mut self, span: Span, kind: Kind<'a>, place: Place<'a>) {
        self.sites.push(Site { span, kind, place });
    }

    fn item(&mut self, item: &'a Item) {
        match item {
            Item::Job { name, .. } => self.push(name.span, Kind::JobName, NOWHERE),
            Item::Use { path, .. } => self.push(path.span, Kind::Path(Path::Use, &path.node), NOWHERE),
            Item::Let { name, value, .. } => {
                self.push(name.span, Kind::Definition(Named::Value, &name.node), NOWHERE);
                self.value(value, NOWHERE, &[]);
            }
            Item::Block(block) => self.block(block),
        }
    }

    fn block(&mut self, block: &'a Block) {
        let Some(Spanned {
            node: HeadPart::Word(first),
            span,
        }) = block.head.first()
        else {
            return;
        };
        let second = match block.head.get(1) {
            Some(Spanned {
                node: HeadPart::Word(second),
                ..
            }) => Some(second.as_str()),
            Some(_) | None => None,
        };
        let kind = self.known.find(first, second);
        let mut place = Place {
            block: kind.map_or(first, |kind| kind.head()),
            ..NOWHERE
        };
        if kind.is_some() {
            place.operation = Some(self.operations);
            self.operations += 1;
        }
        self.push(*span, Kind::Block, place);
        self.head(first, block, place);
        if matches!(first.as_str(), "profile" | "surface" | "region") {
            for entry in &block.entries {
                self.profile_entry(entry, place);
            }
        } else {
            let head = head_words(block);
            let place = Place {
                block: vocabulary::kind_of_blade(&head).unwrap_or(place.block),
                ..place
            };
            self.entries(&block.entries, vocabulary::block(&head, self.known), place);
        }
    }

    /// The words after the first one.
    fn head(&mut self, first: &str, block: &'a Block, place: Place<'a>) {
        for (number, part) in block.head.iter().enumerate().skip(1) {
            let kind = match (&part.node, first, number) {
                (HeadPart::Word(name), "blade", 1) => Kind::Definition(Named::Blade, name),
                (HeadPart::Word(name), "region", 1) => Kind::Definition(Named::Region, name),
                (HeadPart::Word(name), "machine", 1) => Kind::Definition(Named::Machine, name),
                (HeadPart::Word(_), _, _) => Kind::HeadWord,
                (HeadPart::Text(model), "machine", _) => Kind::Path(Path::Model, model),
                (HeadPart::Text(_) | HeadPart::Equals, _, _) => continue,
            };
            self.push(part.span, kind, place);
        }
    }

    fn entries(&mut self, entries: &'a [Entry], spec: Option<&'static BlockSpec>, place: Place<'a>) {
        for entry in entries {
            match entry {
                Entry::Field { name, value, .. } | Entry::Limit { name, value, .. } => {
                    let field = spec.and_then(|spec| spec.field(&name.node));
                    let place = Place { field, ..place };
                    self.push(name.span, Kind::Field(&name.node), place);
                    let is_profile = place.words == Words::OfTarget && name.node == "profile";
                    if let (Expr::Text(path), true) = (&value.node, is_profile) {
                        self.push(value.span, Kind::Path(Path::Profile, path), place);
                    } else {
                        self.value(value, place, &[]);
                    }
                }
                Entry::Formula { .. }
                | Entry::Curve { .. }
                | Entry::SurfaceFile { .. }
                | Entry::Station { .. } => self.profile_entry(entry, place),
                Entry::Row { points, .. } => self.points(points, place),
                Entry::ControlRow { points, .. } => self.control_points(points, place),
                Entry::Block(inner) => self.inner_block(inner, spec, place),
            }
        }
    }

    fn inner_block(&mut self, inner: &'a Block, outer: Option<&'static BlockSpec>, place: Place<'a>) {
        let Some(Spanned {
            node: HeadPart::Word(word),
            span,
        }) = inner.head.first()
        else {
            return;
        };
        let field = outer.and_then(|spec| spec.field(word));
        let within = |block| Place {
            block,
            field,
            ..place
        };
        // `tool dagger { ... }`: the blade is named, and its fields follow.
        if let (Some(spec), Some(second)) = (outer, inner.head.get(1))
            && let (HeadPart::Word(name), None, Some(spec)) =
                (&second.node, inner.head.get(2), spec.block(word, Some("")))
            && field.and_then(FieldSpec::inner).is_none()
        {
            self.push(*span, Kind::Block, within(place.block));
            self.push(second.span, Kind::Reference(name), within(place.block));
            self.entries(&inner.entries, Some(spec), within(word));
            return;
        }
        let is_target = outer.is_some_and(|spec| spec.inner.takes_target_options());
        if let Some(spec) = field.and_then(FieldSpec::inner) {
            self.push(*span, Kind::Block, within(place.block));
            self.entries(&inner.entries, Some(spec), within(word));
        } else if is_target && field.is_none() {
            let place = Place {
                words: Words::OfTarget,
                ..within(word)
            };
            self.push(*span, Kind::Block, place);
            self.entries(&inner.entries, None, place);
        } else {
            self.push(*span, Kind::Block, within(place.block));
            self.entries(&inner.entries, None, within(word));
        }
    }

    fn profile_entry(&mut self, entry: &'a Entry, place: Place<'a>) {
        match entry {
            Entry::Formula {
                name,
                variables,
                value,
                ..
            } => {
                self.push(name.span, Kind::Formula, place);
                for variable in variables {
                    self.push(variable.span, Kind::Variable, place);
                }
                self.value(value, place, variables);
            }
            Entry::SurfaceFile {
                kind, path, options, ..
            } => {
                self.push(path.span, Kind::Path(Path::Data, &path.node), place);
                let word = kind.node.word();
                let place = Place { block: word, ..place };
                self.entries(options, vocabulary::surface_file(word), place);
            }
            Entry::Station {
                word, at, entries, ..
            } => {
                let of_loft = Place {
                    block: "loft",
                    ..place
                };
                self.push(*word, Kind::Block, of_loft);
                self.value(at, place, &[]);
                for entry in entries {
                    self.profile_entry(entry, place);
                }
            }
            Entry::Curve { curve, .. } => self.curve(curve, place),
            Entry::Field { name, value, .. } | Entry::Limit { name, value, .. } => {
                self.push(name.span, Kind::Field(&name.node), place);
                self.value(value, place, &[]);
            }
            Entry::Row { points, .. } => self.points(points, place),
            Entry::ControlRow { points, .. } => self.control_points(points, place),
            Entry::Block(inner) => match inner.head.as_slice() {
                [head] if head.node == HeadPart::Word("nurbs".to_owned()) => {
                    self.nurbs(inner, head.span, place)
                }
                [head] if head.node == HeadPart::Word("island".to_owned()) => {
                    self.push(head.span, Kind::Block, place);
                    for entry in &inner.entries {
                        self.profile_entry(entry, place);
                    }
                }
                _ => self.inner_block(inner, None, place),
            },
        }
    }

    /// A surface by its control points.
    fn nurbs(&mut self, block: &'a Block, head: Span, place: Place<'a>) {
        let place = Place {
            block: "nurbs",
            ..place
        };
        self.push(head, Kind::Block, place);
        self.entries(&block.entries, Some(vocabulary::nurbs()), place);
    }

    fn control_points(&mut self, points: &'a [Spanned<Expr>], place: Place<'a>) {
        for point in points {
            self.value(point, place, &[]);
        }
    }

    fn curve(&mut self, curve: &'a Curve, place: Place<'a>) {
        match curve {
            Curve::Start(point) | Curve::Line { to: point } | Curve::Open { to: point } => {
                self.point(point, place);
            }
            Curve::Circle { center, radius } => {
                self.point(center, place);
                self.value(radius, place, &[]);
            }
            Curve::Arc { to, by } => {
                self.point(to, place);
                match by {
                    ArcBy::Radius(radius) => self.value(radius, place, &[]),
                    ArcBy::Center(point) | ArcBy::Through(point) => self.point(point, place),
                }
            }
            Curve::Bezier { control: inner, to }
            | Curve::Spline { through: inner, to }
            | Curve::Polyline { through: inner, to } => {
                self.points(inner, place);
                self.point(to, place);
            }
            Curve::Points { path, options } => self.data("points", path, options, place),
            Curve::Airfoil { path, options } => self.data("airfoil", path, options, place),
            Curve::Dxf { path, options } => self.data("dxf", path, options, place),
            Curve::Svg { path, options } => self.data("svg", path, options, place),
        }
    }

    fn data(
        &mut self,
        word: &'static str,
        path: &'a Spanned<String>,
        options: &'a [Entry],
        place: Place<'a>,
    ) {
        self.push(path.span, Kind::Path(Path::Data, &path.node), place);
        let is_of_region = place.block == "region";
        let (block, spec) = match vocabulary::region_file(word).filter(|_| is_of_region) {
            Some(spec) => (manual::DRAWING_OF_A_REGION, Some(spec)),
            None => (word, vocabulary::data_file(word)),
        };
        self.entries(options, spec, Place { block, ..place });
    }

    fn points(&mut self, points: &'a [Point], place: Place<'a>) {
        for point in points {
            self.point(point, place);
        }
    }

    fn point(&mut self, point: &'a Point, place: Place<'a>) {
        self.value(&point.first, place, &[]);
        self.value(&point.second, place, &[]);
    }

    /// A whole value, and what is in it.
    fn value(&mut self, value: &'a Spanned<Expr>, place: Place<'a>, variables: &[Spanned<String>]) {
        self.push(value.span, Kind::Value(value), place);
        // A stack of its own: values may be long.
        let mut open = vec![value];
        while let Some(next) = open.pop() {
            self.part(next, place, variables);
            match &next.node {
                Expr::Number { .. } | Expr::Text(_) | Expr::Name(_) => {}
                Expr::Call { function, arguments } => {
                    self.labels(&function.node, arguments, place);
                    open.extend(arguments.iter().map(|argument| &argument.value).rev());
                }
                Expr::Negate(inner) => open.push(inner),
                Expr::Binary { left, right, .. } => open.extend([right.as_ref(), left.as_ref()]),
                Expr::Tuple(values) => open.extend(values.iter().rev()),
            }
        }
    }

    fn labels(&mut self, function: &'a str, arguments: &'a [Argument], place: Place<'a>) {
        for label in arguments.iter().filter_map(|argument| argument.name.as_ref()) {
            self.push(label.span, Kind::Label(function), place);
        }
    }

    fn part(&mut self, part: &'a Spanned<Expr>, place: Place<'a>, variables: &[Spanned<String>]) {
        match &part.node {
            Expr::Number { unit, .. } => {
                self.push(part.span, Kind::Number(part), place);
                if let Some(unit) = unit {
                    self.push(unit.span, Kind::Unit(&unit.node), place);
                }
            }
            Expr::Name(name) => {
                let kind = if variables.iter().any(|variable| variable.node == *name) {
                    Kind::Variable
                } else {
                    bare_word(name, place.field)
                };
                self.push(part.span, kind, place);
            }
            Expr::Call { function, .. } => {
                self.push(function.span, Kind::Function(&function.node), place);
            }
            Expr::Text(_) | Expr::Negate(_) | Expr::Binary { .. } | Expr::Tuple(_) => {}
        }
    }
}

/// What a bare word in the value of a field is.
fn bare_word<'a>(word: &'a str, field: Option<&'static FieldSpec>) -> Kind<'a> {
    if word == "auto" && field.is_none_or(|field| field.leaving == Leaving::Open) {
        return Kind::Auto;
    }
    if RESERVED.contains(&word) {
        return Kind::Word;
    }
    match field.map(|field| field.takes) {
        Some(Takes::Words(_)) => Kind::Word,
        Some(
            Takes::Anything
            | Takes::Quantity(_)
            | Takes::Blade(_)
            | Takes::Region
            | Takes::Machine
            | Takes::Calls(_)
            | Takes::Fields(_),
        )
        | None => Kind::Reference(word),
    }
}

/// The words of a head, with the equals sign as one of them.
fn head_words(block: &Block) -> Vec<&str> {
    let parts = block.head.iter().map(|part| match &part.node {
        HeadPart::Word(text) | HeadPart::Text(text) => text.as_str(),
        HeadPart::Equals => "=",
    });
    parts.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::{BTreeMap, BTreeSet};
    use vcutc_diagnostics::source::{LoadError, Loader, SourceMap};
    use vcutc_job::sema::vocabulary::{Form, Need};
    use vcutc_job::sema::{Choices, check};
    use vcutc_registry::OPERATIONS;

    /// Files in memory.
    struct Shop(BTreeMap<&'static str, String>);

    impl Loader for Shop {
        fn load(&self, path: &str) -> Result<Vec<u8>, LoadError> {
            let text = self.0.get(path).ok_or(LoadError::NotFound)?;
            Ok(text.clone().into_bytes())
        }
    }

    const ROOT: &str = "everything.vcut";

    fn shop() -> Shop {
        let file = |text: &str| text.to_owned();
        Shop(BTreeMap::from([
            (ROOT, file(include_str!("../../tests/check/ok/everything.vcut"))),
            (
                "shop/blades.vcut",
                file(include_str!("../../tests/check/ok/shop/blades.vcut")),
            ),
            (
                "shop/cells.vcut",
                file(include_str!("../../tests/check/ok/shop/cells.vcut")),
            ),
        ]))
    }

    /// Codes and helps of a check.
    fn reported(shop: &Shop) -> Vec<(&'static str, Vec<String>)> {
        let (mut sources, mut found) = (SourceMap::default(), Vec::new());
        check(
            ROOT,
            shop,
            Choices {
                operations: OPERATIONS,
                ..Choices::default()
            },
            &mut sources,
            &mut found,
        )
        .unwrap();
        let reported = found.into_iter();
        reported
            .map(|diagnostic| (diagnostic.code.number(), diagnostic.help))
            .collect()
    }

    fn with(file: &'static str, span: Span, new: &str) -> Vec<(&'static str, Vec<String>)> {
        let mut shop = shop();
        if let Some(text) = shop.0.get_mut(file) {
            text.replace_range(span.bytes(), new);
        }
        reported(&shop)
    }

    fn has(reported: &[(&'static str, Vec<String>)], code: &str) -> bool {
        reported.iter().any(|(found, _)| *found == code)
    }

    /// What the tables say of a field is what the checks do with it.
    #[test]
    fn fields_take_what_their_tables_say() {
        assert!(reported(&shop()).is_empty());
        let mut seen = BTreeSet::new();
        for (file, text) in shop().0 {
            let mut sources = SourceMap::default();
            let id = sources.add(file, text.as_str());
            let ast = vcutc_syntax::parse(id, &text, &mut Vec::new());
            let mut name = None;
            for site in sites(&ast, OPERATIONS) {
                if let Kind::Field(_) = site.kind {
                    name = Some(site.span);
                }
                let (Kind::Value(_), Some(field)) = (site.kind, site.place.field) else {
                    continue;
                };
                seen.insert((site.place.block.to_owned(), field.name));
                holds(file, field, site.span);
                if let Some(name) = name.filter(|_| field.form == Form::Value) {
                    // With the comma after it, which would belong to nothing.
                    let rest = text[site.span.end as usize..].trim_start_matches(' ');
                    let end = text.len() - rest.trim_start_matches(',').len();
                    let whole = Span::of_bytes(id, name.start as usize..end);
                    let missing = has(&with(file, whole, ""), "VC0206");
                    assert_eq!(missing, field.need == Need::Required, "{} without", field.name);
                }
            }
        }
        assert!(seen.len() > 38, "{} fields: {seen:?}", seen.len());
    }

    fn holds(file: &'static str, field: &FieldSpec, span: Span) {
        let name = field.name;
        let as_auto = with(file, span, "auto");
        assert_eq!(
            as_auto.is_empty(),
            field.leaving == Leaving::Open,
            "{name} = auto: {as_auto:?}"
        );
        match field.takes {
            Takes::Quantity(range) => {
                let other = if vocabulary::units_for(range.dimension).contains(&"kg".to_owned()) {
                    "3 mm"
                } else {
                    "3 kg"
                };
                if name != "size" {
                    assert!(has(&with(file, span, other), "VC0203"), "{name} = {other}");
                }
                for unit in vocabulary::units_for(range.dimension) {
                    let fits = with(file, span, &format!("3 {unit}"));
                    assert!(!has(&fits, "VC0203"), "{name} = 3 {unit}: {fits:?}");
                }
            }
            Takes::Words(words) => {
                let mut all = words();
                if field.leaving == Leaving::Open {
                    all.push("auto");
                }
                let help = format!("`{name}` takes one of {}", all.join(", "));
                let reported = with(file, span, "zzzzzzzz");
                assert!(
                    reported.iter().any(|(_, helps)| helps.contains(&help)),
                    "{name}: {reported:?}"
                );
            }
            Takes::Blade(_) | Takes::Region | Takes::Machine => {
                assert!(has(&with(file, span, "zzzzzzzz"), "VC0201"), "{name}");
                assert!(!with(file, span, "reach").is_empty(), "{name}: a value is none");
            }
            Takes::Calls(calls) => {
                let reported = with(file, span, "zzzzzzzz(1)");
                let forms = calls.iter().map(|(_, example)| format!("`{name} = {example}`"));
                let help = format!("write it like {}", forms.collect::<Vec<_>>().join(" or "));
                assert!(
                    reported.iter().any(|(_, helps)| helps.contains(&help)),
                    "{name}: {reported:?}"
                );
            }
            Takes::Anything | Takes::Fields(_) => panic!("{name}: what does it take?"),
        }
    }
}
