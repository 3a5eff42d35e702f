//! The meaning of zeros in a JPEG file's own Huffman code.

/// Of each Huffman table, the symbol whose code is all zero bits: the first one (T.81, Annex C).
///
/// With the tables that most cameras use, zeros decode to a pattern that no picture has, so a block of zeros is damage.
/// Tables made for one picture may give the shortest code to 'nothing changes': then an even colour, such as a covered
/// lens, is written as zeros, and zeros prove nothing.
#[derive(Debug, Default)]
pub(super) struct ZeroCodes {
    dc: [Option<u8>; 4],
    ac: [Option<u8>; 4],
}

impl ZeroCodes {
    /// Takes the tables of a DHT segment; what cannot be read is left out.
    pub fn define(&mut self, mut segment: &[u8]) {
        while let Some((head, rest)) = segment.split_at_checked(17) {
            let symbols: usize = head[1..].iter().map(|count| usize::from(*count)).sum();
            let tables = if head[0] >> 4 == 0 { &mut self.dc } else { &mut self.ac };
            if let Some(table) = tables.get_mut(usize::from(head[0] & 0x0f)) {
                *table = rest.first().copied().filter(|_| symbols > 0);
            }
            segment = rest.get(symbols..).unwrap_or_default();
        }
    }

    /// Whether a scan writes even colour as zeros. `header` is the content of its SOS segment.
    pub fn zeros_are_even_colour(&self, header: &[u8]) -> bool {
        let Some((&count, rest)) = header.split_first() else { return false };
        let Some((components, &[first, last, approximation, ..])) = rest.split_at_checked(2 * usize::from(count))
        else {
            return false;
        };
        let has_dc = first == 0;
        let refines = approximation >> 4 != 0;
        components.chunks_exact(2).all(|component| {
            let of = |tables: &[Option<u8>; 4], id: u8| tables.get(usize::from(id)).copied().flatten();
            // A refined DC value is one plain bit; else category 0 is 'no difference'.
            let is_dc_even = !has_dc || refines || of(&self.dc, component[1] >> 4) == Some(0);
            // End of block, or of a band of blocks; 0xf0 is sixteen zeros, of which a block holds only three.
            let is_ac_even = last == 0
                || of(&self.ac, component[1] & 0x0f).is_some_and(|symbol| symbol & 0x0f == 0 && symbol != 0xf0);
            is_dc_even && is_ac_even
        })
    }
}
