//! Places in the arguments, pointers, structs of all versions, and what may not overlap.

use core::mem::{MaybeUninit, size_of};

use super::memory_use::Bytes;
use super::status::{
    CallResult, FAIRMESH_NO_ELEMENT, Failure, fairmesh_element, fairmesh_error, fairmesh_status as Status,
};

/// A struct that begins with its size.
///
/// # Safety
/// `repr(C)`, the first field the `u32` of its size, every bit pattern a value.
pub(crate) unsafe trait Versioned: Copy {
    /// Its size in the first version that had it, written out: it stays when the struct grows.
    const FIRST: usize;
}

/// An argument, counted from 1.
#[derive(Clone, Copy)]
pub(crate) struct Argument(pub usize);

impl Argument {
    /// A field of the struct that the argument points to.
    pub(crate) fn field(self, offset: usize, name: &'static str) -> FieldPath {
        self.start().field(offset, name)
    }

    /// One of the structs of this type that the argument points to.
    pub(crate) fn element<T>(self, number: usize, name: &'static str) -> FieldPath {
        FieldPath {
            number: Some(number),
            ..self.field(number.wrapping_mul(size_of::<T>()), name)
        }
    }

    /// The struct that the argument points to.
    pub(crate) fn start(self) -> FieldPath {
        FieldPath {
            argument: self.0,
            offset: 0,
            names: [""; 3],
            number: None,
        }
    }

    /// The argument behind it.
    pub(crate) fn next(self) -> Self {
        Self(self.0 + 1)
    }

    pub(crate) fn itself(self) -> FieldPath {
        FieldPath {
            offset: FAIRMESH_NO_ELEMENT,
            ..self.start()
        }
    }
}

/// An argument, or a field in it.
#[derive(Clone, Copy)]
pub(crate) struct FieldPath {
    argument: usize,
    offset: u64,
    /// From the outermost struct's field to the innermost one's.
    names: [&'static str; 3],
    /// Which of several structs.
    number: Option<usize>,
}

impl FieldPath {
    /// A field of this struct.
    pub(crate) fn field(mut self, offset: usize, name: &'static str) -> Self {
        self.offset = self.offset.wrapping_add(offset as u64);
        if let Some(free) = self.names.iter_mut().find(|name| name.is_empty()) {
            *free = name;
        }
        self
    }

    pub(crate) fn refuse(self, status: Status, why: std::fmt::Arguments<'_>) -> Failure {
        self.blame(Failure::new(
            status,
            format_args!("argument {}{self}: {why}", self.argument),
        ))
    }

    /// Says that the failure is this argument's or field's.
    pub(crate) fn blame(self, failure: Failure) -> Failure {
        let other = self.offset;
        Failure { other, ..failure }.at(fairmesh_element::Argument, self.argument)
    }
}

/// The field: `, target.kind`, `, steps[1].value`.
impl std::fmt::Display for FieldPath {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let names = self.names.iter().take_while(|name| !name.is_empty());
        for (k, name) in names.enumerate() {
            write!(f, "{}{name}", if k == 0 { ", " } else { "." })?;
            if let (0, Some(number)) = (k, self.number) {
                write!(f, "[{number}]")?;
            }
        }
        Ok(())
    }
}

/// What is said of a place: `refuse!(place => BadEnum, "{number} is no {of}")`.
macro_rules! refuse {
    ($place:expr => $status:ident, $($why:tt)+) => {
        $place.refuse(super::status::fairmesh_status::$status, format_args!($($why)+))
    };
}
pub(crate) use refuse;

/// The place of a field, named as in the header: `field!(place, fairmesh_join.kind)`.
macro_rules! field {
    ($base:expr, $type:ident . $name:ident) => {
        $base.field(core::mem::offset_of!($type, $name), stringify!($name))
    };
}
pub(crate) use field;

/// The place of the field with this name, of some fields of a struct.
macro_rules! field_named {
    ($base:expr, $name:expr, $type:ident: $($field:ident)*) => {
        match $name {
            $(name if name == stringify!($field) => Some(field!($base, $type.$field)),)*
            _ => None,
        }
    };
}
pub(crate) use field_named;

pub(crate) fn aligned<T>(pointer: *const T, to: usize) -> bool {
    (pointer as usize).is_multiple_of(to)
}

/// Checks a pointer to something.
pub(crate) fn check_pointer<T>(pointer: *const T, argument: Argument) -> CallResult {
    if pointer.is_null() {
        return Err(refuse!(argument.itself() => NullPointer, "NULL"));
    }
    if !aligned(pointer, align_of::<T>()) {
        return Err(refuse!(argument.itself() => Misaligned, "misaligned"));
    }
    Ok(())
}

/// In sizes of the struct that this library knows: a newer one is smaller than so many. A size beyond was not set, and what lies behind the
/// struct is not the struct's. At half, none could grow; at double, less is caught.
const GROWTH: usize = 2;

fn size_of_struct<T: Versioned>(pointer: *const T, argument: Argument) -> CallResult<usize> {
    check_pointer(pointer, argument)?;
    // SAFETY: not NULL and aligned; by contract it is a struct that begins with its size.
    let size = unsafe { pointer.cast::<u32>().read() } as usize;
    check_size::<T>(size, argument.field(0, "struct_size"))
}

pub(crate) fn check_size<T: Versioned>(size: usize, place: FieldPath) -> CallResult<usize> {
    if size < T::FIRST || size > GROWTH * size_of::<T>() || !size.is_multiple_of(size_of::<usize>()) {
        let (first, known) = (T::FIRST, size_of::<T>());
        return Err(
            refuse!(place => BadStructSize, "struct_size is {size}; this library knows {first} to {known}"),
        );
    }
    Ok(size)
}

fn read_struct<T: Versioned>(pointer: *const T, size: usize, argument: Argument) -> CallResult<T> {
    let known = size.min(size_of::<T>());
    let mut value = MaybeUninit::<T>::zeroed();
    // SAFETY: by contract the caller's struct has `size` bytes; every bit pattern is a value.
    unsafe {
        pointer
            .cast::<u8>()
            .copy_to_nonoverlapping(value.as_mut_ptr().cast(), known);
        for k in known..size {
            if pointer.cast::<u8>().add(k).read() != 0 {
                let place = argument.start().field(k, "a field");
                return Err(refuse!(place => BadReserved, "unknown to this library, and not zero"));
            }
        }
        Ok(value.assume_init())
    }
}

/// Where a struct of any version goes.
pub(crate) struct StructOut<T> {
    pointer: *mut T,
    size: usize,
}

impl<T: Versioned> StructOut<T> {
    pub(crate) fn new(pointer: *mut T, argument: Argument, call: &mut Call) -> CallResult<Self> {
        let size = size_of_struct(pointer, argument)?;
        call.output(Bytes::block(pointer, size), argument)?;
        Ok(Self { pointer, size })
    }

    pub(crate) fn optional(pointer: *mut T, argument: Argument, call: &mut Call) -> CallResult<Option<Self>> {
        (!pointer.is_null())
            .then(|| Self::new(pointer, argument, call))
            .transpose()
    }

    /// Writes what the caller's version has. `struct_size` stays the caller's.
    pub(crate) fn write(&self, value: &T) {
        let known = self.size.min(size_of::<T>());
        // SAFETY: by contract the caller's struct has `size` bytes.
        unsafe {
            let (from, to) = ((value as *const T).cast::<u8>(), self.pointer.cast::<u8>());
            to.add(4).copy_from_nonoverlapping(from.add(4), known - 4);
            to.add(known).write_bytes(0, self.size - known);
        }
    }
}

/// Fills a struct of this size with a value; for the `init` functions.
pub(crate) fn init_struct<T: Versioned>(pointer: *mut T, size: usize, value: &T) -> CallResult {
    check_pointer(pointer, Argument(1))?;
    check_size::<T>(size, Argument(2).itself())?;
    StructOut { pointer, size }.write(value);
    // SAFETY: as above.
    unsafe { pointer.cast::<u32>().write(size as u32) };
    Ok(())
}

/// Where a pointer to a handle goes.
pub(crate) fn check_slot<T>(slot: *mut *mut T, argument: Argument, call: &mut Call) -> CallResult {
    check_pointer(slot, argument)?;
    call.output(Bytes::block(slot, size_of::<*mut T>()), argument)
}

/// No call reads more arrays and structs than this before it knows its outputs: `fairmesh_bridge` reads 22.
const INPUTS: usize = 22;

/// What a call writes.
#[derive(Clone, Copy)]
struct Output {
    bytes: Bytes,
    argument: Argument,
    /// The error detail, in which nothing can be said then.
    silent: bool,
}

/// What a call reads and writes: outputs overlap nothing.
pub(crate) struct Call {
    inputs: [Bytes; INPUTS],
    input_count: usize,
    outputs: [Option<Output>; 6],
    error: Bytes,
}

impl Call {
    pub(crate) fn new(error: *mut fairmesh_error) -> Self {
        let bytes = size_of::<fairmesh_error>() * usize::from(!error.is_null());
        Self {
            inputs: [Bytes::default(); INPUTS],
            input_count: 0,
            outputs: [None; 6],
            error: Bytes::block(error, bytes),
        }
    }

    pub(crate) fn input(&mut self, bytes: Bytes) {
        if !bytes.is_empty() {
            self.inputs[self.input_count] = bytes;
            self.input_count += 1;
        }
    }

    /// An input that is found when all outputs are known: there may be any number of them.
    pub(crate) fn late_input(&self, bytes: Bytes) -> CallResult {
        let mut outputs = self.outputs.iter().flatten();
        outputs
            .find(|output| !bytes.is_empty() && output.bytes.overlaps(&bytes))
            .map_or(Ok(()), |output| Err(output.overlaps()))
    }

    /// Inputs have to be told before.
    pub(crate) fn output(&mut self, bytes: Bytes, argument: Argument) -> CallResult {
        self.add_output(Output {
            bytes,
            argument,
            silent: false,
        })
    }

    /// All arguments but the last one, the error detail, are known.
    pub(crate) fn end(&mut self, argument: Argument) -> CallResult {
        self.add_output(Output {
            bytes: self.error,
            argument,
            silent: true,
        })
    }

    fn add_output(&mut self, output: Output) -> CallResult {
        if output.bytes.is_empty() {
            return Ok(());
        }
        let others = self.outputs.iter().flatten();
        if self.is_read(&output.bytes) || others.clone().any(|other| other.bytes.overlaps(&output.bytes)) {
            return Err(output.overlaps());
        }
        if let Some(free) = self.outputs.iter_mut().find(|output| output.is_none()) {
            *free = Some(output);
        }
        Ok(())
    }

    /// Whether the error detail lies in what is known to be read, so that nothing may be written there.
    pub(crate) fn error_is_read(&self) -> bool {
        !self.error.is_empty() && self.is_read(&self.error)
    }

    fn is_read(&self, bytes: &Bytes) -> bool {
        self.inputs[..self.input_count]
            .iter()
            .any(|input| input.overlaps(bytes))
    }

    /// Reads a struct that never grows.
    pub(crate) fn read<T: Copy>(&mut self, pointer: *const T, argument: Argument) -> CallResult<T> {
        check_pointer(pointer, argument)?;
        self.input(Bytes::block(pointer, size_of::<T>()));
        Ok(read(pointer))
    }

    /// Reads a struct of any version. Fields that it does not have yet are zero; fields that this library does not know yet
    /// have to be.
    pub(crate) fn read_struct<T: Versioned>(
        &mut self,
        pointer: *const T,
        argument: Argument,
    ) -> CallResult<T> {
        let size = size_of_struct(pointer, argument)?;
        self.input(Bytes::block(pointer, size));
        read_struct(pointer, size, argument)
    }

    /// Reads options, which may be NULL.
    pub(crate) fn read_options<T: Versioned>(
        &mut self,
        pointer: *const T,
        argument: Argument,
        standard: fn() -> T,
    ) -> CallResult<T> {
        if pointer.is_null() {
            return Ok(standard());
        }
        self.read_struct(pointer, argument)
    }
}

impl Output {
    fn overlaps(&self) -> Failure {
        let why = format_args!("overlaps what another argument points to");
        Failure {
            silent: self.silent,
            ..self.argument.itself().refuse(Status::Aliasing, why)
        }
    }
}

/// Reads from a place that was checked.
pub(crate) fn read<T: Copy>(from: *const T) -> T {
    // SAFETY: every caller has checked it for NULL and alignment; integers, floats and pointers, of any bits.
    unsafe { from.read() }
}

/// Writes to a place that was checked.
pub(crate) fn write<T>(to: *mut T, value: T) {
    // SAFETY: every caller has checked it for NULL and alignment; by contract it is ours to write.
    unsafe { to.write(value) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A struct that has grown: its first version ended before `added`.
    #[repr(C)]
    #[derive(Debug, Clone, Copy, PartialEq)]
    struct Grown {
        struct_size: u32,
        reserved: u32,
        old: u64,
        added: u64,
    }

    // SAFETY: integers; the first is the size.
    unsafe impl Versioned for Grown {
        const FIRST: usize = 16;
    }

    const ARGUMENT: Argument = Argument(1);

    fn call() -> Call {
        Call::new(core::ptr::null_mut())
    }

    /// A program of the first version.
    #[test]
    fn a_shorter_struct_reads_as_zeros_and_is_not_written_behind_its_end() {
        let mut memory = [16, 7, u64::MAX];
        let pointer = memory.as_mut_ptr().cast::<Grown>();
        let read = call().read_struct(pointer, ARGUMENT).ok().unwrap();
        assert_eq!((read.old, read.added), (7, 0));
        let out = StructOut::new(pointer, ARGUMENT, &mut call()).ok().unwrap();
        out.write(&Grown {
            struct_size: 24,
            reserved: 0,
            old: 8,
            added: 9,
        });
        assert_eq!(memory, [16, 8, u64::MAX]);
    }

    /// A program of a version to come.
    #[test]
    fn a_longer_struct_is_read_if_its_end_is_zero_and_its_end_is_cleared() {
        let mut memory = [32, 7, 6, 0, u64::MAX];
        let pointer = memory.as_mut_ptr().cast::<Grown>();
        let read = call().read_struct(pointer, ARGUMENT).ok().unwrap();
        assert_eq!((read.old, read.added), (7, 6));
        memory[3] = 1;
        let pointer = memory.as_mut_ptr().cast::<Grown>();
        let refused = call().read_struct(pointer, ARGUMENT).err().unwrap();
        assert_eq!((refused.status, refused.other), (Status::BadReserved, 24));
        let out = StructOut::new(pointer, ARGUMENT, &mut call()).ok().unwrap();
        out.write(&read);
        assert_eq!(memory, [32, 7, 6, 0, u64::MAX]);
    }

    #[test]
    fn a_struct_shorter_than_the_first_version_is_refused() {
        let mut memory = [8_u64, 7, 6];
        let refused = call()
            .read_struct(memory.as_mut_ptr().cast::<Grown>(), ARGUMENT)
            .err()
            .unwrap();
        assert_eq!(refused.status, Status::BadStructSize);
    }
}
