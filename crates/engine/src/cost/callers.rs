//! Functions of Rhai's library that are handed closures: the steps of the closure pay for them.

/// Functions that call a closure and keep nothing of it.
const CALLERS: [&str; 18] = [
    "all",
    "dedup",
    "drain",
    "filter",
    "find",
    "find_map",
    "for_each",
    "index_of",
    "map",
    "order",
    "order_by",
    "reduce",
    "reduce_rev",
    "retain",
    "some",
    "sort",
    "sort_by",
    "zip",
];

/// True for the name of a function that is handed closures; a helper of that name could keep one.
pub(crate) fn is_caller(name: &str) -> bool {
    CALLERS.contains(&name)
}
