//! The procedures of the graphs in the languages of the others. What is not here reads the same in all three.

/// Rhai, JavaScript, Python.
const BODIES: [[&str; 3]; 10] = [
    ["6.0 / ball.size", "6.0 / ball.size", r#"6.0 / ball["size"]"#],
    [
        "#{x: ball.x, d: 6.0 / ball.size}",
        "({x: ball.x, d: 6.0 / ball.size})",
        r#"{"x": ball["x"], "d": 6.0 / ball["size"]}"#,
    ],
    [
        r#"if angle < 0.0 { "left" } else { "right" }"#,
        r#"angle < 0.0 ? "left" : "right""#,
        r#""left" if angle < 0.0 else "right""#,
    ],
    ["distance > 2.0", "distance > 2.0", "distance > 2.0"],
    ["distance > 1.0 && distance <= 2.0", "distance > 1.0 && distance <= 2.0", "distance > 1.0 and distance <= 2.0"],
    ["xD.d <= 1.0", "xD.d <= 1.0", r#"xD["d"] <= 1.0"#],
    ["close.x", "close.x", r#"close["x"]"#],
    [
        "#{v: yawAt.v + ballAt.v, t: yawAt.t - ballAt.t}",
        "({v: yawAt.v + ballAt.v, t: yawAt.t - ballAt.t})",
        r#"{"v": yawAt["v"] + ballAt["v"], "t": yawAt["t"] - ballAt["t"]}"#,
    ],
    ["combined.t < 1000", "combined.t < 1000", r#"combined["t"] < 1000"#],
    ["recent.v", "recent.v", r#"recent["v"]"#],
];

/// A body in JavaScript and in Python.
pub(crate) fn in_js_and_python(body: &str) -> [&str; 2] {
    BODIES.iter().find(|[rhai, ..]| *rhai == body).map_or([body; 2], |[_, js, python]| [*js, *python])
}
