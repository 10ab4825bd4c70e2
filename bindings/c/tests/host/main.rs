//! The archive on a desktop: the header is that of the code, programs in C and C++ get the bits
//! that the core gives, and misuse is refused.

mod bits;
mod compile;
mod examples;
mod header;
mod misuse;
