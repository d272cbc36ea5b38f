//! Which robots have which devices, as far as that is known without asking one.

/// A kind of robot.
#[derive(Clone, Copy, Debug)]
pub struct Model {
    /// What people call it.
    pub name: &'static str,
    /// The devices of the catalogue that it does not have.
    pub lacks: &'static [&'static str],
}

/// All kinds.
pub const MODELS: [Model; 3] = [
    Model { name: "NAO", lacks: &["Tablet"] },
    Model { name: "NAO without hands (H21)", lacks: &["HandTouch", "Tablet"] },
    Model { name: "Pepper", lacks: &[] },
];
