//! What the language reference says about each word: the one place where the words are explained.
//!
//! `docs/language.md` is compiled in, and its tables are read when they are asked for. A row explains the words in backquotes
//! of its first cell. Tests compare the tables with those of the checks: no field without a row, and none
//! marked as required that is not.

const REFERENCE: &str = include_str!("../../docs/language.md");

/// A drawing of a region among the blocks of [`Table::Fields`].
pub(super) const DRAWING_OF_A_REGION: &str = "drawing of a region";

/// A table of the reference.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Table<'a> {
    /// The fields of a block: `rough vcut`, `limits`.
    Fields(&'a str),
    /// The pieces of a profile.
    Pieces,
    /// The pieces of a region.
    Loops,
    /// The words that join the parts of a piece.
    Joints,
    /// The files that a profile can be.
    Files,
    /// What a surface can be.
    Sources,
    /// The kinds of machines.
    Machines,
    /// The kinds of blades.
    Blades,
    /// The calls that fields of a machine take.
    Calls,
    /// The functions of calculations.
    Functions,
    /// What each strategy for cuts at the part does.
    Residuals,
    /// How each field of a block that is left open is chosen.
    Auto(&'a str),
    /// In which formulas each value enters.
    Formulas,
}

/// A row of a table.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    line: &'static str,
}

impl Row {
    fn cells(self) -> Vec<&'static str> {
        let inner = self.line.trim().trim_start_matches('|').trim_end_matches('|');
        inner.split(" | ").map(str::trim).collect()
    }

    /// What the row says: all cells but the first, joined. The last one of three is a default.
    pub(super) fn text(self) -> String {
        match self.cells().as_slice() {
            [_, text, default] if !default.is_empty() => {
                format!("{}\n\nDefault: {}", without_links(text), without_links(default))
            }
            [_, text, ..] => without_links(text),
            _ => String::new(),
        }
    }

    /// The first cell: the words that it explains, as they are written.
    pub(super) fn head(self) -> &'static str {
        self.cells().first().copied().unwrap_or_default()
    }

    /// Whether it explains a word.
    pub(super) fn explains(self, word: &str) -> bool {
        self.words().any(|known| known == word)
    }

    /// Whether the first cell says that the field must be there.
    #[cfg(test)]
    pub(super) fn is_required(self) -> bool {
        self.head().contains("(required)")
    }

    /// The words that it explains.
    fn words(self) -> impl Iterator<Item = &'static str> {
        self.head().split('`').skip(1).step_by(2).map(|quoted| {
            let end = quoted.find(['(', ' ', ',']).unwrap_or(quoted.len());
            quoted.get(..end).unwrap_or_default()
        })
    }
}

/// The row of a table that explains a word.
pub(super) fn row(table: Table<'_>, word: &str) -> Option<Row> {
    rows(table).find(|row| row.explains(word))
}

/// The rows of a table.
pub(super) fn rows(table: Table<'_>) -> impl Iterator<Item = Row> + Clone {
    let start = match table {
        Table::Fields(block) => fields_table(block),
        Table::Pieces => headed("| Piece |"),
        Table::Loops => headed("| Piece of a region |"),
        Table::Joints => headed("| Word in a piece |"),
        Table::Files => headed("| File | Holds |"),
        Table::Sources => headed("| Source | Is |"),
        Table::Machines => headed("| Kind | Is |"),
        Table::Blades => headed("| Kind of blade | Is |"),
        Table::Calls => headed("| Value | Meaning |"),
        Table::Functions => headed("| Function |"),
        Table::Residuals => headed("| `residual` | Such a cut is |"),
        Table::Auto(block) => match section(block) {
            "rough rect" => headed("| Field of `rough rect` | Chosen as |"),
            "finish disc" => headed("| Field of `finish disc` | Chosen as |"),
            "clear pocket" => headed("| Field of `clear pocket` | Chosen as |"),
            "free pocket" => headed("| Field of `free pocket` | Chosen as |"),
            _ => headed("| Field | Chosen as |"),
        },
        Table::Formulas => headed("| Value | Enters |"),
    };
    let body = start.map_or("", |at| REFERENCE.get(at..).unwrap_or_default());
    // The head and the line under it.
    body.lines()
        .skip(2)
        .take_while(|line| line.starts_with('|'))
        .map(|line| Row { line })
}

/// Where the table of a block's fields begins.
fn fields_table(block: &str) -> Option<usize> {
    match block {
        "limits" => headed("| Limit |"),
        "change" => headed("| Field of `change` |"),
        "feed" => after("`feed { ... }`", "| Field |"),
        "forces" => headed("| Field of `forces` |"),
        "measured" => headed("| Field of `measured` |"),
        "points" => headed("| Field of `points` |"),
        "airfoil" => headed("| Field of `airfoil` |"),
        "dxf" | "svg" => headed("| Field of `dxf` and `svg` |"),
        DRAWING_OF_A_REGION => headed("| Field of a drawing of a region |"),
        "mesh" => headed("| Field of `mesh` |"),
        "grid" => headed("| Field of `grid` |"),
        "step" => headed("| Field of `step` |"),
        "nurbs" => headed("| Field of `nurbs` |"),
        "disc" => headed("| Field of `disc` |"),
        "crusher" => headed("| Field of `crusher` |"),
        _ => after(&format!("\n### `{}`\n", section(block)), "| Field |"),
    }
}

/// The section about a block: one of a process within `rough auto` is that of the process alone.
fn section(block: &str) -> &str {
    match block {
        "vcut" => "rough vcut",
        "rect" => "rough rect",
        _ => block,
    }
}

fn headed(head: &str) -> Option<usize> {
    REFERENCE.find(&format!("\n{head}")).map(|at| at + 1)
}

/// The first table of that head after a text.
fn after(text: &str, head: &str) -> Option<usize> {
    let start = REFERENCE.find(text)?;
    let tail = REFERENCE.get(start..)?;
    let at = tail.find(&format!("\n{head}"))?;
    Some(start + at + 1)
}

/// The paragraph that begins so.
fn paragraph(beginning: &str) -> Option<String> {
    let start = REFERENCE.find(&format!("\n{beginning}"))?;
    let paragraph = REFERENCE.get(start..)?.trim_start().split("\n\n").next()?;
    Some(without_links(paragraph))
}

/// The clause of a row that explains one of several words: `` `rows`: layer by layer ``.
pub(super) fn clause<'r>(row: &'r str, word: &str) -> Option<&'r str> {
    let lead = format!("`{word}`: ");
    let start = row.find(&lead)? + lead.len();
    row.get(start..)?.split([';', '\n']).next()
}

/// The first paragraph about a block that is not an example.
pub(super) fn about(block: &str) -> Option<String> {
    match block {
        // What `use` does is explained in the section about files.
        "use" => return paragraph("The path is relative to the file"),
        "default" => return paragraph("The word `default`"),
        _ => {}
    }
    let heading = format!("\n### `{}`\n", section(block));
    let start = REFERENCE.find(&heading)? + heading.len();
    let section = REFERENCE.get(start..)?;
    let section = section.split("\n#").next()?;
    let mut is_example = false;
    let paragraphs = section.split("\n\n").filter(|paragraph| {
        let begins = paragraph.trim_start().starts_with("```");
        let fences = paragraph.matches("```").count();
        let inside = is_example;
        if fences % 2 == 1 {
            is_example = !is_example;
        }
        !inside && !begins && !paragraph.trim().is_empty() && !paragraph.trim_start().starts_with('|')
    });
    let first = paragraphs.into_iter().next()?;
    Some(without_links(first.trim()))
}

/// Markdown without links between pages, which lead nowhere in an editor: their words stay.
fn without_links(text: &str) -> String {
    let mut plain = String::new();
    let mut rest = text;
    while let Some(at) = rest.find("](") {
        let before = rest.get(..at).unwrap_or_default();
        let open = before.rfind('[').unwrap_or(at);
        plain.push_str(before.get(..open).unwrap_or_default());
        plain.push_str(before.get(open + 1..).unwrap_or_default());
        let tail = rest.get(at..).unwrap_or_default();
        let end = tail.find(')').map_or(tail.len(), |end| end + 1);
        rest = tail.get(end..).unwrap_or_default();
    }
    plain + rest
}

#[cfg(test)]
mod tests {
    use super::*;
    use vcutc_job::sema::vocabulary::{self, BlockSpec, Form, Need, Takes};
    use vcutc_registry::OPERATIONS;
    use vcutc_syntax::ast::SurfaceFile;

    fn blocks() -> Vec<(&'static str, &'static BlockSpec)> {
        let tops = [
            "stock",
            "blade",
            "rough vcut",
            "rough rect",
            "rough auto",
            "finish disc",
            "clear pocket",
            "free pocket",
            "machine",
            "cell",
        ];
        let spec = |head: &str| {
            let words: Vec<&str> = head.split(' ').collect();
            vocabulary::block(&words, OPERATIONS).unwrap()
        };
        let mut all: Vec<_> = tops.into_iter().map(|head| (head, spec(head))).collect();
        for kind in ["disc", "crusher"] {
            let head = ["blade", "b", "=", kind];
            all.push((kind, vocabulary::block(&head, OPERATIONS).unwrap()));
        }
        for word in ["points", "airfoil", "dxf", "svg"] {
            all.push((word, vocabulary::data_file(word).unwrap()));
        }
        for word in ["dxf", "svg"] {
            all.push((DRAWING_OF_A_REGION, vocabulary::region_file(word).unwrap()));
        }
        for word in SurfaceFile::ALL.map(SurfaceFile::word) {
            all.push((word, vocabulary::surface_file(word).unwrap()));
        }
        all.push(("nurbs", vocabulary::nurbs()));
        let inner: Vec<_> = all
            .iter()
            .flat_map(|(_, spec)| spec.fields)
            .filter_map(|field| match field.takes {
                Takes::Fields(spec) => Some((field.name, spec)),
                _ => None,
            })
            .collect();
        all.extend(inner);
        all
    }

    #[test]
    fn every_field_is_explained_and_marked_as_the_checks_take_it() {
        let all = blocks();
        assert!(all.len() >= 9, "{all:?}");
        for (block, spec) in all {
            // Of these the reference says in a sentence that all fields are required.
            let all_required = matches!(block, "feed" | "cell");
            for field in spec.fields {
                if field.form == Form::Block {
                    assert!(
                        rows(Table::Fields(field.name)).count() > 2,
                        "{block} {}",
                        field.name
                    );
                }
                if block == "cell" {
                    assert!(about("cell").unwrap().contains("machine"));
                    continue;
                }
                let row = row(Table::Fields(block), field.name);
                let row = row.unwrap_or_else(|| panic!("no row for {block} {}", field.name));
                assert!(row.text().len() > 8, "{block} {}: {}", field.name, row.text());
                let is_required = row.is_required() || all_required;
                assert_eq!(
                    is_required,
                    field.need == Need::Required,
                    "{block} {}",
                    field.name
                );
            }
        }
    }

    #[test]
    fn every_other_word_is_explained() {
        for (name, _) in vocabulary::functions() {
            assert!(row(Table::Functions, name).is_some(), "{name}");
        }
        for (word, _) in vocabulary::CURVES {
            let table = match vocabulary::data_file(word) {
                Some(_) => Table::Files,
                None => Table::Pieces,
            };
            assert!(row(table, word).is_some(), "{word}");
        }
        for (word, _) in vocabulary::LOOPS {
            assert!(row(Table::Loops, word).is_some(), "{word}");
        }
        let sources = vocabulary::SURFACES.iter().chain([&vocabulary::STATION]);
        for word in sources.map(|(word, _)| *word).chain(["z"]) {
            assert!(row(Table::Sources, word).is_some(), "{word}");
        }
        for word in vocabulary::head_words("blade", OPERATIONS) {
            assert!(row(Table::Blades, word).is_some(), "{word}");
        }
        for block in [
            "job",
            "stock",
            "profile",
            "surface",
            "blade",
            "rough vcut",
            "rough rect",
            "rough auto",
            "finish disc",
            "region",
            "clear pocket",
            "free pocket",
            "machine",
            "cell",
            "let",
            "auto",
            "use",
        ] {
            assert!(
                about(block).is_some_and(|text| text.len() > 20),
                "{block}: {:?}",
                about(block)
            );
        }
        for (block, spec) in blocks() {
            for field in spec.fields {
                if let Takes::Calls(calls) = field.takes {
                    for (call, _) in calls {
                        assert!(
                            row(Table::Calls, call).is_some(),
                            "{block} {}: {call}",
                            field.name
                        );
                    }
                }
            }
        }
    }

    /// What enters a formula says so.
    #[test]
    fn values_of_an_operation_name_their_formulas() {
        for word in [
            "cutting_length",
            "half_apex",
            "thickness",
            "rake",
            "swing",
            "layer",
            "step",
            "overlap",
            "cut",
            "travel",
            "reorient",
            "clearance",
            "extension",
            "run_out",
            "standoff",
            "allowance",
            "scallop",
            "edge",
            "time",
            "cuts",
            "size",
        ] {
            let row = row(Table::Formulas, word).unwrap_or_else(|| panic!("{word} enters nothing"));
            assert!(row.text().contains('`'), "{word}: {}", row.text());
        }
    }

    #[test]
    fn links_become_words() {
        assert_eq!(
            without_links("see [x](a.md#b) and [Cui 4] or [y](c)."),
            "see x and [Cui 4] or y."
        );
    }
}
