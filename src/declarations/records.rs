//! The structs of the C interface, field by field, for the languages that have types of their own for them.

use syn::{Attribute, Expr, Fields, Item, Lit, Meta, Type};

use crate::python::{is_c_name, is_opaque, last_name, number};

/// 64 bits that may say that there is nothing.
const MAY_BE_NONE: [&str; 7] = [
    "worst_triangle",
    "normal_deviation_vertex",
    "boundary_kink_vertex",
    "reason_element",
    "reason_other",
    "element",
    "other",
];

/// A struct.
pub struct Record {
    /// Its name in C.
    pub name: String,
    /// What is said about it.
    pub doc: String,
    /// Its fields, in their order.
    pub fields: Vec<Field>,
}

/// A field.
pub struct Field {
    /// Its name in C.
    pub name: String,
    /// A type of Rust, an enumeration or a struct of C, or one of `text`, `chars`, `pointer`, `flag`, `status`, `or_none`.
    pub kind: String,
    /// Of arrays how many they have, otherwise 1.
    pub count: usize,
    /// What is said about it.
    pub doc: String,
}

impl Field {
    /// Whether it tells anything.
    pub fn is_told(&self) -> bool {
        self.name != "struct_size" && !self.name.starts_with("reserved")
    }

    /// What is said about it, without what its type says.
    pub fn said(&self) -> String {
        let doc = &self.doc;
        let said = doc.strip_prefix("Not 0: ").unwrap_or(doc);
        let said = said.strip_prefix(&format!("A `{}`: ", self.kind)).unwrap_or(said);
        said[..1].to_uppercase() + &said[1..]
    }
}

/// All structs that are no handles.
pub fn all(items: &[Item]) -> Vec<Record> {
    items.iter().filter_map(record).collect()
}

/// What is said about an item.
pub fn doc(attributes: &[Attribute]) -> String {
    let mut lines = Vec::new();
    for attribute in attributes {
        if let Meta::NameValue(pair) = &attribute.meta
            && pair.path.is_ident("doc")
            && let Expr::Lit(literal) = &pair.value
            && let Lit::Str(text) = &literal.lit
        {
            lines.push(text.value().trim().to_owned());
        }
    }
    lines.join(" ").replace(" Set `struct_size` before the call.", "")
}

fn record(item: &Item) -> Option<Record> {
    let Item::Struct(item) = item else { return None };
    let name = item.ident.to_string();
    let Fields::Named(fields) = &item.fields else {
        return None;
    };
    if !is_c_name(&name) || is_opaque(&name) {
        return None;
    }
    let doc = doc(&item.attrs);
    let fields = fields.named.iter().map(field).collect();
    Some(Record { name, doc, fields })
}

fn field(field: &syn::Field) -> Field {
    let name = field.ident.as_ref().expect("named").to_string();
    let doc = doc(&field.attrs);
    let (kind, count) = match &field.ty {
        Type::Ptr(pointer) if last_name(&pointer.elem) == "c_char" => ("text".to_owned(), 1),
        Type::Ptr(_) => ("pointer".to_owned(), 1),
        Type::Array(array) => {
            let count = number(&array.len).parse().expect("a length");
            match last_name(&array.elem).as_str() {
                "c_char" => ("chars".to_owned(), count),
                "f64" => ("f64".to_owned(), count),
                other => panic!("an array of {other}"),
            }
        }
        of => (plain(&name, &last_name(of), &doc), 1),
    };
    Field {
        name,
        kind,
        count,
        doc,
    }
}

fn plain(name: &str, of: &str, doc: &str) -> String {
    match of {
        _ if name == "status" || name == "refused_status" => "status",
        "u32" if name == "gap_kind" => "fairmesh_gap_kind",
        "u32" if doc.starts_with("Not 0") => "flag",
        "u32" => match doc.strip_prefix("A `").and_then(|rest| rest.split_once('`')) {
            Some((named, _)) => named,
            None => of,
        },
        "u64" if MAY_BE_NONE.contains(&name) => "or_none",
        "fairmesh_progress_fn" => "pointer",
        _ => of,
    }
    .to_owned()
}
