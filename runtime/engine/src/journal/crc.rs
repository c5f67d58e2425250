//! CRC-32 of IEEE 802.3, reflected, as zlib, gzip and PNG have it: every standard library can check it.

/// The reversed polynomial.
const POLYNOMIAL: u32 = 0xEDB8_8320;

/// The remainder of each byte.
const TABLE: [u32; 256] = table();

#[expect(clippy::indexing_slicing, reason = "the index runs over the table's own length")]
const fn table() -> [u32; 256] {
    let mut table = [0; 256];
    let mut byte = 0;
    while byte < 256 {
        let mut remainder = byte as u32;
        let mut bit = 0;
        while bit < 8 {
            let odd = remainder & 1 == 1;
            remainder = if odd { (remainder >> 1) ^ POLYNOMIAL } else { remainder >> 1 };
            bit += 1;
        }
        table[byte] = remainder;
        byte += 1;
    }
    table
}

/// The checksum of some bytes.
pub(super) fn of(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |remainder: u32, byte| {
        let index = (remainder ^ u32::from(*byte)) & 0xFF;
        TABLE.get(index as usize).map_or(0, |entry| (remainder >> 8) ^ entry)
    })
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_check_value() {
        // The catalogue's check value of CRC-32/ISO-HDLC.
        assert_eq!(super::of(b"123456789"), 0xCBF4_3926);
        assert_eq!(super::of(b""), 0);
    }
}
