//! Numbers in a row and their names, in one list: what a kernel takes and returns as tables cannot be read in another
//! order than it was written.

/// A struct of numbers that come in a row: `FIELDS` are their names in order, `from_row` takes them apart by name.
macro_rules! numbers {
    ($(#[$about:meta])* $name:ident { $($(#[$doc:meta])* $field:ident,)+ }) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, Default, PartialEq)]
        pub struct $name {
            $($(#[$doc])* pub $field: f64,)+
        }

        impl $name {
            /// Names of the numbers, in the order of a row.
            pub const FIELDS: [&'static str; [$(stringify!($field)),+].len()] = [$(stringify!($field)),+];

            /// Take the numbers of a row.
            pub fn from_row(row: &[f64; Self::FIELDS.len()]) -> Self {
                let [$($field),+] = *row;
                $name { $($field),+ }
            }
        }
    };
}

/// Columns of the tables made of a type: each a name and what stands under it. `FIELDS` are the names, `row` the numbers.
macro_rules! columns {
    ($type:ty, $of:ident => { $($name:literal: $value:expr,)+ }) => {
        impl $type {
            /// Names of the columns.
            pub const FIELDS: [&'static str; [$($name),+].len()] = [$($name),+];

            /// The numbers, one for each column.
            pub fn row(&self) -> [f64; [$($name),+].len()] {
                let $of = self;
                [$($value),+]
            }
        }
    };
}

/// An enum whose variants have names for people; they leave the kernel as their places in `NAMES`.
macro_rules! named {
    ($(#[$about:meta])* $type:ident { $($(#[$doc:meta])* $variant:ident = $name:literal,)+ }) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[repr(u8)]
        #[non_exhaustive]
        pub enum $type {
            $($(#[$doc])* $variant,)+
        }

        impl $type {
            /// All variants.
            pub const ALL: [Self; [$($name),+].len()] = [$($type::$variant),+];
            /// Their names.
            pub const NAMES: [&'static str; [$($name),+].len()] = [$($name),+];

            /// The variant of that name, if there is one.
            pub fn named(name: &str) -> Option<Self> {
                let place = Self::NAMES.iter().position(|known| *known == name)?;
                Some(Self::ALL[place])
            }
        }
    };
}

pub(crate) use {columns, named, numbers};
