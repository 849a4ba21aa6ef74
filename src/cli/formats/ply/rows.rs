//! Walking through the rows of a PLY element without copying them.

use std::ops::Range;

use crate::failure::Malformed;
use crate::formats::ply::header::{Element, Encoding, Header, PropertyKind, Scalar};
use crate::text::{self, Layout, Words};

/// Where a property of a row is: its number, or the items of its list without their count.
pub type Field = Range<usize>;

/// An element's rows in the bytes of a file.
pub struct Rows<'a> {
    pub bytes: &'a [u8],
    pub encoding: Encoding,
    /// Of a text.
    pub layout: Layout,
    pub element: &'a Element,
}

impl<'a> Rows<'a> {
    /// The rows of an element.
    pub fn of(bytes: &'a [u8], header: &Header, layout: Layout, element: &'a Element) -> Self {
        Self {
            bytes,
            encoding: header.encoding,
            layout,
            element,
        }
    }
}

impl Rows<'_> {
    /// An error at this offset, told by line or by byte as the file is text or binary.
    pub fn malformed(&self, at: usize, what: impl Into<String>) -> Malformed {
        Malformed {
            at,
            by_line: self.encoding == Encoding::Ascii,
            what: what.into(),
        }
    }

    fn cut_short(&self, at: usize) -> Malformed {
        self.malformed(
            at,
            format!("the file ends within element '{}'", self.element.name),
        )
    }

    /// The number of rows, if the bytes from `at` on can hold as many at all.
    pub fn check_count(&self, at: usize) -> Result<usize, Malformed> {
        let least = self.element.least_row(self.encoding) as u128;
        // The last row of a text needs no line end.
        let room = (self.bytes.len() - at) as u128 + 1;
        let (name, count) = (&self.element.name, self.element.count);
        if u128::from(count) * least > room {
            let what = format!(
                "the header promises {count} rows of '{name}', more than the rest of the file can hold"
            );
            return Err(self.malformed(at, what));
        }
        // Rows of nothing take no space and are not walked.
        Ok(if least == 0 { 0 } else { count as usize })
    }

    /// Where the row at `at` really begins: blank lines of a text are passed over.
    pub fn start(&self, at: usize) -> Result<usize, Malformed> {
        if self.encoding != Encoding::Ascii {
            return Ok(at);
        }
        let start = self.layout.start(self.bytes, at);
        start.ok_or_else(|| self.cut_short(self.bytes.len()))
    }

    /// Visits every property of the row at `at`; returns where the next row begins.
    pub fn walk(
        &self,
        at: usize,
        visit: &mut impl FnMut(usize, Field) -> Result<(), Malformed>,
    ) -> Result<usize, Malformed> {
        match self.encoding {
            Encoding::Ascii => self.walk_text(at, visit),
            _ => self.walk_binary(at, visit),
        }
    }

    fn walk_text(
        &self,
        at: usize,
        visit: &mut impl FnMut(usize, Field) -> Result<(), Malformed>,
    ) -> Result<usize, Malformed> {
        let mut words = self.layout.words(self.bytes, at);
        for (property, described) in self.element.properties.iter().enumerate() {
            let word = self.word(&mut words, at, property)?;
            let field = match described.kind {
                PropertyKind::Scalar(_) => word,
                PropertyKind::List { .. } => {
                    let items = text::integer(self.bytes, word.clone(), "length of a list")?;
                    let items = usize::try_from(items)
                        .map_err(|_| self.malformed(at, format!("a list of length {items}")))?;
                    let mut range = word.end..word.end;
                    for _ in 0..items {
                        range.end = self.word(&mut words, at, property)?.end;
                    }
                    range
                }
            };
            visit(property, field)?;
        }
        // The header says all that a row has: one number more, and nobody knows which.
        if self.layout == Layout::Lines && words.clone().next().is_some() {
            let what = format!(
                "this row of element '{}' has more numbers than the header says",
                self.element.name
            );
            return Err(self.malformed(at, what));
        }
        Ok(self.layout.next(self.bytes, &words))
    }

    fn word(&self, words: &mut Words<'_>, at: usize, property: usize) -> Result<Range<usize>, Malformed> {
        words.next().ok_or_else(|| {
            let name = &self.element.properties[property].name;
            self.malformed(
                at,
                format!("this row of element '{}' ends before '{name}'", self.element.name),
            )
        })
    }

    fn walk_binary(
        &self,
        at: usize,
        visit: &mut impl FnMut(usize, Field) -> Result<(), Malformed>,
    ) -> Result<usize, Malformed> {
        let mut at = at;
        for (property, described) in self.element.properties.iter().enumerate() {
            let (size, items) = match described.kind {
                PropertyKind::Scalar(scalar) => (scalar.size(), 1),
                PropertyKind::List { count, item } => {
                    let end = at + count.size();
                    let length = self.bytes.get(at..end).ok_or_else(|| self.cut_short(at))?;
                    let length = decode(self.encoding, count, length);
                    if length < 0.0 {
                        return Err(self.malformed(at, format!("a list of length {length}")));
                    }
                    at = end;
                    (item.size(), length as usize)
                }
            };
            let left = self.bytes.len() - at;
            let length = size.checked_mul(items).filter(|&length| length <= left);
            let end = at + length.ok_or_else(|| self.cut_short(at))?;
            visit(property, at..end)?;
            at = end;
        }
        Ok(at)
    }

    /// The value of a number.
    pub fn scalar(&self, property: usize, field: &Field) -> Result<f64, Malformed> {
        let described = &self.element.properties[property];
        match (self.encoding, described.kind) {
            (Encoding::Ascii, _) => text::number(self.bytes, field.clone(), &described.name),
            (_, PropertyKind::Scalar(scalar) | PropertyKind::List { item: scalar, .. }) => {
                Ok(decode(self.encoding, scalar, &self.bytes[field.clone()]))
            }
        }
    }

    /// The values of a list.
    pub fn numbers(&self, property: usize, field: &Field) -> Result<Vec<f64>, Malformed> {
        let described = &self.element.properties[property];
        match (self.encoding, described.kind) {
            (Encoding::Ascii, _) => text::words(self.bytes, field.clone())
                .map(|word| text::number(self.bytes, word, &described.name))
                .collect(),
            (_, PropertyKind::Scalar(scalar) | PropertyKind::List { item: scalar, .. }) => {
                let items = self.bytes[field.clone()].chunks_exact(scalar.size());
                Ok(items.map(|item| decode(self.encoding, scalar, item)).collect())
            }
        }
    }

    /// The values of a list of whole numbers.
    pub fn integers(&self, property: usize, field: &Field, values: &mut Vec<i64>) -> Result<(), Malformed> {
        values.clear();
        let described = &self.element.properties[property];
        match (self.encoding, described.kind) {
            (Encoding::Ascii, _) => {
                for word in text::words(self.bytes, field.clone()) {
                    values.push(text::integer(self.bytes, word, &described.name)?);
                }
            }
            (_, PropertyKind::Scalar(scalar) | PropertyKind::List { item: scalar, .. }) => {
                let items = self.bytes[field.clone()].chunks_exact(scalar.size());
                values.extend(items.map(|item| decode(self.encoding, scalar, item) as i64));
            }
        }
        Ok(())
    }
}

/// Bytes in the machine-independent order that the file has them in, at most 8.
fn ordered<const N: usize>(encoding: Encoding, bytes: &[u8]) -> [u8; N] {
    let mut ordered = [0; N];
    ordered.copy_from_slice(&bytes[..N]);
    if encoding == Encoding::Big {
        ordered.reverse();
    }
    ordered
}

/// A binary number; `bytes` is as long as the type.
fn decode(encoding: Encoding, scalar: Scalar, bytes: &[u8]) -> f64 {
    match scalar {
        Scalar::I8 => f64::from(bytes[0] as i8),
        Scalar::U8 => f64::from(bytes[0]),
        Scalar::I16 => f64::from(i16::from_le_bytes(ordered(encoding, bytes))),
        Scalar::U16 => f64::from(u16::from_le_bytes(ordered(encoding, bytes))),
        Scalar::I32 => f64::from(i32::from_le_bytes(ordered(encoding, bytes))),
        Scalar::U32 => f64::from(u32::from_le_bytes(ordered(encoding, bytes))),
        Scalar::F32 => f64::from(f32::from_le_bytes(ordered(encoding, bytes))),
        Scalar::F64 => f64::from_le_bytes(ordered(encoding, bytes)),
    }
}

/// A float or double as the file writes it.
pub fn encode(encoding: Encoding, scalar: Scalar, value: f64) -> Vec<u8> {
    let mut bytes = match (encoding, scalar) {
        (Encoding::Ascii, Scalar::F32) => return text::single(value as f32).into_bytes(),
        (Encoding::Ascii, _) => return text::double(value).into_bytes(),
        (_, Scalar::F32) => (value as f32).to_le_bytes().to_vec(),
        _ => value.to_le_bytes().to_vec(),
    };
    if encoding == Encoding::Big {
        bytes.reverse();
    }
    bytes
}
