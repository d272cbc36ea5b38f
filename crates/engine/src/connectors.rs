//! What connectors do with values.
