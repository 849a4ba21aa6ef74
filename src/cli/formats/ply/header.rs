//! The header of a PLY file.

use crate::failure::Malformed;
use crate::text;

/// How the rows are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Encoding {
    Ascii,
    Little,
    Big,
}

/// A number's type.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    fn parse(name: &str) -> Option<Self> {
        Some(match name {
            "char" | "int8" => Scalar::I8,
            "uchar" | "uint8" => Scalar::U8,
            "short" | "int16" => Scalar::I16,
            "ushort" | "uint16" => Scalar::U16,
            "int" | "int32" => Scalar::I32,
            "uint" | "uint32" => Scalar::U32,
            "float" | "float32" => Scalar::F32,
            "double" | "float64" => Scalar::F64,
            _ => return None,
        })
    }

    /// Bytes of a binary number.
    pub fn size(self) -> usize {
        match self {
            Scalar::I8 | Scalar::U8 => 1,
            Scalar::I16 | Scalar::U16 => 2,
            Scalar::I32 | Scalar::U32 | Scalar::F32 => 4,
            Scalar::F64 => 8,
        }
    }

    /// Not float or double.
    pub fn is_integer(self) -> bool {
        !matches!(self, Scalar::F32 | Scalar::F64)
    }
}

/// One number or a list of numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PropertyKind {
    Scalar(Scalar),
    List { count: Scalar, item: Scalar },
}

impl PropertyKind {
    /// The type of a list's items.
    pub fn item(self) -> Option<Scalar> {
        match self {
            Self::List { item, .. } => Some(item),
            Self::Scalar(_) => None,
        }
    }
}

/// A column of an element.
#[derive(Debug, Clone, PartialEq)]
pub struct Property {
    pub name: String,
    pub kind: PropertyKind,
}

/// A table of the file.
#[derive(Debug, Clone, PartialEq)]
pub struct Element {
    pub name: String,
    /// Number of rows, as promised.
    pub count: u64,
    pub properties: Vec<Property>,
    /// Where in the file the element is declared.
    pub at: usize,
}

impl Element {
    /// The number of the property with this name.
    pub fn property(&self, name: &str) -> Option<usize> {
        self.properties.iter().position(|property| property.name == name)
    }

    /// The number of a face's list of corners.
    pub fn vertex_indices(&self) -> Option<usize> {
        self.property("vertex_indices")
            .or_else(|| self.property("vertex_index"))
    }

    /// The fewest bytes that a row takes: in binary its fixed part, in text a digit and a gap per property.
    pub fn least_row(&self, encoding: Encoding) -> usize {
        if encoding == Encoding::Ascii {
            return 2 * self.properties.len();
        }
        let sizes = self.properties.iter().map(|property| match property.kind {
            PropertyKind::Scalar(scalar) => scalar.size(),
            PropertyKind::List { count, .. } => count.size(),
        });
        sizes.sum()
    }
}

/// The whole header.
#[derive(Debug, Clone, PartialEq)]
pub struct Header {
    pub encoding: Encoding,
    pub elements: Vec<Element>,
    /// Where the first row begins.
    pub end: usize,
}

/// Reads the header, from `ply` to `end_header`.
pub fn parse(bytes: &[u8]) -> Result<Header, Malformed> {
    let (first, mut at) = text::line(bytes, text::start(bytes));
    // Behind a lone CR the first byte of a binary file may be anything, an LF too.
    let is_lone_cr = bytes.get(first.end) == Some(&b'\r') && at == first.end + 1;
    if bytes[first].trim_ascii_end() != b"ply" {
        return Err(Malformed::text(
            0,
            "this is not a PLY file: it does not begin with the line 'ply'",
        ));
    }
    let mut encoding = None;
    let mut elements: Vec<Element> = Vec::new();
    while at < bytes.len() {
        let (range, next) = text::line(bytes, at);
        let end = if is_lone_cr {
            (range.end + 1).min(bytes.len())
        } else {
            next
        };
        let line = String::from_utf8_lossy(&bytes[range]);
        let words: Vec<&str> = line.split_ascii_whitespace().collect();
        match words.as_slice() {
            [] | ["comment" | "obj_info", ..] => {}
            ["format", name, "1.0"] => encoding = Some(parse_encoding(name, at)?),
            ["format", ..] => {
                return Err(Malformed::text(
                    at,
                    "the format line has to be 'format ENCODING 1.0'",
                ));
            }
            ["element", name, count] => elements.push(parse_element(name, count, at, &elements)?),
            ["property", rest @ ..] => {
                let property = parse_property(rest, at)?;
                let element = elements
                    .last_mut()
                    .ok_or_else(|| Malformed::text(at, "a property before the first element"))?;
                element.properties.push(property);
            }
            ["end_header"] => {
                let encoding =
                    encoding.ok_or_else(|| Malformed::text(at, "the header has no 'format' line"))?;
                return Ok(Header {
                    encoding,
                    elements,
                    end,
                });
            }
            _ => {
                let word = text::shown(line.trim().as_bytes(), 0..line.trim().len());
                return Err(Malformed::text(at, format!("header line {word} is not PLY")));
            }
        }
        at = end;
    }
    Err(Malformed::text(
        bytes.len(),
        "the file ends within the header: 'end_header' is missing",
    ))
}

fn parse_encoding(name: &str, at: usize) -> Result<Encoding, Malformed> {
    match name {
        "ascii" => Ok(Encoding::Ascii),
        "binary_little_endian" => Ok(Encoding::Little),
        "binary_big_endian" => Ok(Encoding::Big),
        _ => Err(Malformed::text(
            at,
            "unknown format; it must be ascii, binary_little_endian or binary_big_endian",
        )),
    }
}

fn parse_element(name: &str, count: &str, at: usize, earlier: &[Element]) -> Result<Element, Malformed> {
    let count = count.parse::<u64>().map_err(|_| {
        Malformed::text(
            at,
            format!("the number of rows of element '{name}' is not a count"),
        )
    })?;
    let is_mesh = name == "vertex" || name == "face";
    if is_mesh && earlier.iter().any(|element| element.name == name) {
        return Err(Malformed::text(at, format!("element '{name}' is declared twice")));
    }
    Ok(Element {
        name: name.to_owned(),
        count,
        properties: Vec::new(),
        at,
    })
}

fn parse_property(words: &[&str], at: usize) -> Result<Property, Malformed> {
    let scalar = |name: &str| {
        Scalar::parse(name).ok_or_else(|| {
            let shown = text::shown(name.as_bytes(), 0..name.len());
            Malformed::text(at, format!("unknown property type {shown}"))
        })
    };
    match words {
        ["list", count, item, name] => {
            let (count, item) = (scalar(count)?, scalar(item)?);
            if !count.is_integer() {
                return Err(Malformed::text(
                    at,
                    "the length of a list must have an integer type",
                ));
            }
            Ok(Property {
                name: (*name).to_owned(),
                kind: PropertyKind::List { count, item },
            })
        }
        [kind, name] => Ok(Property {
            name: (*name).to_owned(),
            kind: PropertyKind::Scalar(scalar(kind)?),
        }),
        _ => Err(Malformed::text(at, "a property needs a type and a name")),
    }
}
