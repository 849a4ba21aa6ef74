//! Arrays of the caller: checked before they are read, and read or written element by element.

use std::borrow::Cow;
use std::ffi::c_void;

use super::memory;
use super::memory_use::Bytes;
use super::status::{CallResult, Failure, fairmesh_element, fairmesh_status as Status};
pub(crate) use super::structs::*;
use super::types::*;

/// What is known of an array after the checks.
#[derive(Clone, Copy)]
pub(crate) struct Array {
    pub data: *mut u8,
    pub count: usize,
    pub stride: usize,
    row: usize,
    /// Bytes from the first to behind the last.
    pub bytes: usize,
}

/// Checks an array of rows of `width` numbers, `size` bytes each. `at` are the places of data, count and stride.
fn array(
    data: *const c_void,
    count: usize,
    stride: usize,
    width: usize,
    size: usize,
    at: [FieldPath; 3],
) -> CallResult<Array> {
    let row = width * size;
    if data.is_null() && count > 0 {
        return Err(refuse!(at[0] => NullPointer, "NULL, but the count is {count}"));
    }
    if !aligned(data, size) {
        return Err(refuse!(at[0] => Misaligned, "data has to be aligned to {size} bytes"));
    }
    let stride = if stride == 0 { row } else { stride };
    if stride < row {
        return Err(refuse!(at[2] => BadStride, "stride {stride} is less than {row}"));
    }
    if !stride.is_multiple_of(size) {
        return Err(refuse!(at[2] => Misaligned, "stride {stride} is no multiple of {size}"));
    }
    let bytes = match count {
        0 => Some(0),
        n => (n - 1).checked_mul(stride).and_then(|b| b.checked_add(row)),
    };
    let fits = bytes.filter(|&b| b <= isize::MAX as usize && (data as usize).checked_add(b).is_some());
    let Some(bytes) = fits else {
        return Err(refuse!(at[1] => CountOverflow, "{count} times {stride} bytes is too much"));
    };
    Ok(Array {
        data: data as *mut u8,
        count,
        stride,
        row,
        bytes,
    })
}

fn numbers_size(scalar: u32, place: FieldPath) -> CallResult<usize> {
    match scalar {
        1 => Ok(4),
        2 => Ok(8),
        other => Err(refuse!(place => BadEnum, "{other} is no fairmesh_scalar")),
    }
}

pub(crate) fn check_reserved(reserved: u32, place: FieldPath) -> CallResult {
    if reserved == 0 {
        return Ok(());
    }
    Err(refuse!(place => BadReserved, "reserved, but {reserved}"))
}

/// Places of the fields of an array struct that begins at `base`.
macro_rules! places {
    ($type:ident, $base:expr) => {
        [
            field!($base, $type.data),
            field!($base, $type.count),
            field!($base, $type.stride),
        ]
    };
}

/// Numbers to be read or written, rows of `N`.
#[derive(Clone, Copy)]
pub(crate) struct Numbers<const N: usize> {
    pub array: Array,
    pub double: bool,
}

pub(crate) type Points = Numbers<3>;

/// Rows of `$width` numbers from a view of type `$view`.
macro_rules! numbers {
    ($name:ident, $view:ident, $width:literal) => {
        impl Numbers<$width> {
            pub(crate) fn $name(view: &$view, base: FieldPath) -> CallResult<Self> {
                check_reserved(view.reserved, field!(base, $view.reserved))?;
                let size = numbers_size(view.scalar, field!(base, $view.scalar))?;
                let at = places!($view, base);
                let array = array(view.data, view.count, view.stride, $width, size, at)?;
                let double = size == 8;
                Ok(Self { array, double })
            }
        }
    };
}

numbers!(points_in, fairmesh_points, 3);
numbers!(numbers_in, fairmesh_numbers, 1);
numbers!(points_out, fairmesh_points_out, 3);
numbers!(scalars_out, fairmesh_scalars_out, 1);

impl<const N: usize> Numbers<N> {
    pub(crate) fn get(&self, k: usize) -> [f64; N] {
        debug_assert!(k < self.array.count);
        // SAFETY: row k of an array that was checked; by contract the caller's memory holds it.
        unsafe {
            let row = self.array.data.add(k * self.array.stride);
            if self.double {
                row.cast::<[f64; N]>().read()
            } else {
                row.cast::<[f32; N]>().read().map(f64::from)
            }
        }
    }

    /// As the library wants them: without a copy where they are so already.
    pub(crate) fn read<'a>(&self) -> CallResult<Cow<'a, [[f64; N]]>> {
        if self.array.count == 0 {
            return Ok(Cow::Borrowed(&[]));
        }
        if self.double && self.array.stride == 8 * N {
            // SAFETY: checked for NULL, alignment and size; nobody writes it during the call, by contract.
            return Ok(Cow::Borrowed(unsafe {
                std::slice::from_raw_parts(self.array.data.cast(), self.array.count)
            }));
        }
        let mut points = try_with_capacity(self.array.count)?;
        points.extend((0..self.array.count).map(|k| self.get(k)));
        Ok(Cow::Owned(points))
    }

    /// Exactly so many rows.
    pub(crate) fn check_count(&self, count: usize, argument: Argument) -> CallResult {
        check_count(
            self.array.count,
            count,
            argument.field(size_of::<usize>(), "count"),
        )
    }

    /// Whether all of these can be written. Infinity is no number, except where the library says so itself.
    pub(crate) fn check_range(&self, rows: impl Iterator<Item = (usize, [f64; N])>) -> CallResult {
        if self.double {
            return Ok(());
        }
        for (v, row) in rows {
            if row.iter().any(|x| x.is_finite() && !(*x as f32).is_finite()) {
                let failure =
                    Failure::new(Status::NotFinite, format_args!("vertex {v} does not fit a float"));
                return Err(failure.at(fairmesh_element::Vertex, v));
            }
        }
        Ok(())
    }

    pub(crate) fn set(&self, k: usize, row: [f64; N]) {
        debug_assert!(k < self.array.count);
        // SAFETY: row k of an array that was checked; by contract the caller's memory holds it and is ours to write.
        unsafe {
            let to = self.array.data.add(k * self.array.stride);
            if self.double {
                to.cast::<[f64; N]>().write(row);
            } else {
                to.cast::<[f32; N]>().write(row.map(|x| x as f32));
            }
        }
    }

    pub(crate) fn same_as(&self, other: &Self) -> bool {
        self.array.data == other.array.data
            && self.array.stride == other.array.stride
            && self.array.count == other.array.count
            && self.double == other.double
    }
}

/// A vector with room for so many.
pub(crate) fn try_with_capacity<T>(count: usize) -> CallResult<Vec<T>> {
    let mut vec = Vec::new();
    let reserved = memory::without_reserve(|| vec.try_reserve_exact(count));
    reserved.map_err(|_| Failure::out_of_memory())?;
    Ok(vec)
}

/// Rows of indices to be read.
pub(crate) fn indices_in(view: &fairmesh_indices, width: usize, base: FieldPath) -> CallResult<Array> {
    array(
        view.data.cast(),
        view.count,
        view.stride,
        width,
        4,
        places!(fairmesh_indices, base),
    )
}

impl Array {
    /// Where it is.
    pub(crate) fn memory(&self) -> Bytes {
        Bytes::rows(self.data, self.bytes, self.row, self.stride)
    }

    /// Row `k` of `N` indices.
    pub(crate) fn index<const N: usize>(&self, k: usize) -> [u32; N] {
        debug_assert!(k < self.count);
        // SAFETY: row k of an array that was checked; by contract the caller's memory holds it.
        unsafe { self.data.add(k * self.stride).cast::<[u32; N]>().read() }
    }

    pub(crate) fn byte(&self, k: usize) -> u8 {
        debug_assert!(k < self.count);
        // SAFETY: as above.
        unsafe { self.data.add(k * self.stride).read() }
    }

    pub(crate) fn put<const N: usize>(&self, k: usize, row: [u32; N]) {
        debug_assert!(k < self.count);
        // SAFETY: row k of an array that was checked; by contract the caller's memory holds it and is ours to write.
        unsafe { self.data.add(k * self.stride).cast::<[u32; N]>().write(row) };
    }

    /// As the library wants them: without a copy where they are so already.
    pub(crate) fn rows<'a, const N: usize>(&self) -> CallResult<Cow<'a, [[u32; N]]>> {
        if self.count == 0 {
            return Ok(Cow::Borrowed(&[]));
        }
        if self.stride == 4 * N {
            // SAFETY: checked for NULL, alignment and size; nobody writes it during the call, by contract.
            return Ok(Cow::Borrowed(unsafe {
                std::slice::from_raw_parts(self.data.cast(), self.count)
            }));
        }
        let mut rows = try_with_capacity(self.count)?;
        rows.extend((0..self.count).map(|k| self.index::<N>(k)));
        Ok(Cow::Owned(rows))
    }

    /// Single indices.
    pub(crate) fn list<'a>(&self) -> CallResult<Cow<'a, [u32]>> {
        Ok(match self.rows::<1>()? {
            Cow::Borrowed(rows) => Cow::Borrowed(rows.as_flattened()),
            Cow::Owned(rows) => Cow::Owned(rows.into_flattened()),
        })
    }

    /// Single indices, all below `limit`; `what` names one: "the selection names element".
    pub(crate) fn known(&self, limit: usize, element: fairmesh_element, what: &str) -> CallResult<Vec<u32>> {
        let mut list = try_with_capacity(self.count)?;
        for k in 0..self.count {
            list.push(known(self.index::<1>(k)[0], limit, element, what)?);
        }
        Ok(list)
    }
}

/// An index, if it is below `limit`.
pub(crate) fn known(index: u32, limit: usize, element: fairmesh_element, what: &str) -> CallResult<u32> {
    if (index as usize) < limit {
        return Ok(index);
    }
    let why = format_args!("{what} {index}, but there are only {limit}");
    Err(Failure::new(Status::SelectionOutOfRange, why).at(element, index as usize))
}

/// The entries of a selection: bytes or indices.
pub(crate) fn entries(selection: &fairmesh_selection, size: usize, argument: Argument) -> CallResult<Array> {
    let at = places!(fairmesh_selection, argument.start());
    array(selection.data, selection.count, selection.stride, 1, size, at)
}

/// Checks structs that lie one after the other in memory; the argument behind them is their count.
pub(crate) fn check_structs<T>(
    structs: *const T,
    count: usize,
    argument: Argument,
    call: &mut Call,
    what: &str,
) -> CallResult {
    if count > 0 {
        check_pointer(structs, argument)?;
    }
    let bytes = count.checked_mul(size_of::<T>());
    let fits =
        |bytes: &usize| *bytes <= isize::MAX as usize && (structs as usize).checked_add(*bytes).is_some();
    let Some(bytes) = bytes.filter(fits) else {
        return Err(
            refuse!(argument.next().itself() => CountOverflow, "{count} {what} are more than memory has room for"),
        );
    };
    call.input(Bytes::block(structs, bytes));
    Ok(())
}

/// Triangles to be written.
pub(crate) fn triangles_out(view: &fairmesh_indices_out, argument: Argument) -> CallResult<Array> {
    let at = places!(fairmesh_indices_out, argument.start());
    array(view.data.cast(), view.count, view.stride, 3, 4, at)
}

/// A list of indices to be written.
pub(crate) fn list_out(data: *mut u32, capacity: usize) -> CallResult<Array> {
    let [at, count] = [Argument(4).itself(), Argument(5).itself()];
    array(data.cast(), capacity, 0, 1, 4, [at, count, count])
}

pub(crate) fn check_count(got: usize, wanted: usize, place: FieldPath) -> CallResult {
    if got == wanted {
        return Ok(());
    }
    Err(refuse!(place => CountMismatch, "{got}, but it has to be {wanted}"))
}
