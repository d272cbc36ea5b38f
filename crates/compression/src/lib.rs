//! Makes a file small for its way to the browser. A room of its own because brotli is compiled for the readers and writers that
//! its caller gives it, and only that part of the build has to be fast.

use brotli::enc::BrotliEncoderParams;
use brotli::enc::backward_references::BrotliEncoderMode;
use std::io::{self, Write};

/// The quality at which nothing is spared.
const FULL_QUALITY: i32 = 11;
/// Ways to cut a content in blocks (0: its own choice) and to weigh its bytes. None is the best for all: code of 3 MB differs by up
/// to 5 KB, and a small change of it can make another one the best.
const WAYS: [(BrotliEncoderMode, i32); 3] = [
    (BrotliEncoderMode::BROTLI_MODE_GENERIC, 0),
    (BrotliEncoderMode::BROTLI_MODE_GENERIC, 20),
    (BrotliEncoderMode::BROTLI_MODE_FONT, 0),
];

/// Brotli (RFC 7932) of `content`; `quality` is how hard it looks, from 0 to 11. A higher one takes longer and makes it smaller.
///
/// # Errors
/// None is known: it works in memory alone. The type is that of the library.
pub fn brotli(content: &[u8], quality: i32) -> io::Result<Vec<u8>> {
    let ways = if quality < FULL_QUALITY { &WAYS[..1] } else { &WAYS };
    let mut smallest: Option<Vec<u8>> = None;
    for (mode, lgblock) in ways {
        // Told how much there is, it looks for a better way to cut it.
        let (lgwin, size_hint) = (22, content.len());
        let params =
            BrotliEncoderParams { quality, lgwin, lgblock: *lgblock, mode: *mode, size_hint, ..Default::default() };
        let mut out = Vec::new();
        brotli::BrotliCompress(&mut &content[..], &mut out, &params)?;
        smallest = smallest.filter(|least| least.len() <= out.len()).or(Some(out));
    }
    Ok(smallest.unwrap_or_default())
}

/// Gzip (RFC 1952) of `content`, as small as the library makes it.
///
/// # Errors
/// None is known: it works in memory alone. The type is that of the library.
pub fn gzip(content: &[u8]) -> io::Result<Vec<u8>> {
    let mut press = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::best());
    press.write_all(content)?;
    press.finish()
}

#[cfg(test)]
mod tests {
    use super::{brotli, gzip};
    use std::io::{self, Read};

    #[test]
    fn what_was_made_small_is_smaller_and_comes_back_whole() -> io::Result<()> {
        let content = b"let there be light; ".repeat(1_000);
        let read = |from: &mut dyn Read| {
            let mut all = Vec::new();
            from.read_to_end(&mut all).map(|_| all)
        };
        let (hard, quick, zipped) = (brotli(&content, 11)?, brotli(&content, 0)?, gzip(&content)?);
        assert!([&hard, &quick, &zipped].into_iter().all(|small| small.len() < content.len() / 10));
        for pressed in [hard, quick] {
            assert_eq!(read(&mut ::brotli::Decompressor::new(pressed.as_slice(), 4_096))?, content);
        }
        assert_eq!(read(&mut flate2::read::GzDecoder::new(zipped.as_slice()))?, content);
        Ok(())
    }
}
