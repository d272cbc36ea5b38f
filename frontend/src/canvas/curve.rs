//! Where connectors run: the chip between its streams and the curves through it.

use crate::layout::{CHIP_HEIGHT, STREAM_HEIGHT};
use behaviour::{Place, StreamKind};
use std::fmt::Write;

/// Where a chip stands: the middle of its top edge. Above its ordinary stream; half way to an action, which may be
/// reached from several sides.
pub(super) fn chip_place(inputs: &[Place], output: Place, output_kind: StreamKind) -> Place {
    if inputs.is_empty() {
        return Place { x: output.x, y: output.y - CHIP_HEIGHT - 22.0 };
    }
    let lowest = inputs.iter().map(|place| place.y).fold(f64::MIN, f64::max) + STREAM_HEIGHT;
    let middle = inputs.iter().map(|place| place.x).sum::<f64>() / inputs.len() as f64;
    let x = if output_kind == StreamKind::Actuator { (middle + output.x) / 2.0 } else { output.x };
    Place { x, y: (lowest + output.y) / 2.0 - CHIP_HEIGHT / 2.0 }
}

/// The curves from every input to the chip and on to the output, with a small head at the end.
pub(super) fn curves(inputs: &[Place], chip: Place, output: Place) -> String {
    let mut path = String::new();
    for input in inputs {
        curve(&mut path, (input.x, input.y + STREAM_HEIGHT), (chip.x, chip.y));
    }
    curve(&mut path, (chip.x, chip.y + CHIP_HEIGHT), (output.x, output.y - 2.0));
    let (x, y) = (output.x, output.y - 2.0);
    let _ = write!(path, "M{:.0} {:.0}L{x:.0} {y:.0}L{:.0} {:.0}", x - 4.5, y - 6.0, x + 4.5, y - 6.0);
    path
}

/// An S that leaves and arrives upright.
fn curve(path: &mut String, from: (f64, f64), to: (f64, f64)) {
    let bend = ((to.1 - from.1).abs() / 2.0).clamp(4.0, 120.0);
    let _ = write!(
        path,
        "M{:.0} {:.0}C{:.0} {:.0} {:.0} {:.0} {:.0} {:.0}",
        from.0,
        from.1,
        from.0,
        from.1 + bend,
        to.0,
        to.1 - bend,
        to.0,
        to.1
    );
}

#[cfg(test)]
mod tests {
    use super::{chip_place, curves};
    use behaviour::{Place, StreamKind};

    const TOP: Place = Place { x: 0.0, y: 0.0 };

    #[test]
    fn a_chip_stands_midway() {
        let below = Place { x: 200.0, y: 140.0 };
        assert_eq!(chip_place(&[TOP], below, StreamKind::Ordinary), Place { x: 200.0, y: 80.0 });
        assert_eq!(chip_place(&[TOP], below, StreamKind::Actuator).x, 100.0);
        assert_eq!(chip_place(&[], below, StreamKind::Ordinary).y, 90.0);
    }

    #[test]
    fn every_input_has_its_curve() {
        let below = Place { x: 0.0, y: 140.0 };
        let path = curves(&[TOP, Place { x: 90.0, y: 0.0 }], Place { x: 0.0, y: 80.0 }, below);
        assert_eq!(path.matches('C').count(), 3);
        assert!(path.starts_with("M0 48C0 64 0 64 0 80M90 48C90 64 0 64 0 80M0 108C"));
    }
}
