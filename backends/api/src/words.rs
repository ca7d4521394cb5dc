//! Numbers with what they count, as people read them.

/// `1 layer`, `2 layers`, `2 changes of blade`.
#[must_use]
pub fn counted(count: usize, one: &str) -> String {
    match (count, one.split_once(' ')) {
        (1, _) => format!("1 {one}"),
        (_, Some((noun, rest))) => format!("{count} {noun}s {rest}"),
        (_, None) => format!("{count} {one}s"),
    }
}
