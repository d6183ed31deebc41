//! Intersection programs in the assembly languages of the time, embedded.

use crate::card::kernels;

kernels! {
    /// Every program of this folder.
    ALL:
    ONE_ORIGIN_SETUP "one_origin.vsa"
    ONE_ORIGIN_BOTH_SETUP "one_origin_both.vsa"
    ANY_ORIGIN_SETUP "any_origin.vsa"
    SEVEN_VECTORS_SETUP "seven_vectors.vsa"
    ONE_ORIGIN_UNSIGNED "one_origin_unsigned.psa"
    ONE_ORIGIN_SIGNED "one_origin_signed.psa"
    ANY_ORIGIN_UNSIGNED "any_origin_unsigned.psa"
    ANY_ORIGIN_SIGNED "any_origin_signed.psa"
    ANY_ORIGIN_BYTES "any_origin_bytes.psa"
    ANY_ORIGIN_BOTH_UNSIGNED "any_origin_both_unsigned.psa"
    ANY_ORIGIN_BOTH_SIGNED "any_origin_both_signed.psa"
    FLOAT "float.psa"
    FLOAT_BOTH "float_both.psa"
    VERTEX_TEST "vertex_test.vsa"
    ID "id.psa"
    ANY_ORIGIN_BUCKET_SETUP "any_origin_bucket.vsa"
    SEVEN_VECTORS_BUCKET_SETUP "seven_vectors_bucket.vsa"
    ONE_ORIGIN_SHARED_SETUP "one_origin_shared.vsa"
    ONE_ORIGIN_BOTH_SHARED_SETUP "one_origin_both_shared.vsa"
    ONE_ORIGIN_SHARED_UNSIGNED "one_origin_shared_unsigned.psa"
    ONE_ORIGIN_SHARED_SIGNED "one_origin_shared_signed.psa"
    SEVEN_VECTORS_SHARED_SETUP "seven_vectors_shared.vsa"
    FLOAT_SHARED "float_shared.psa"
    FLOAT_BOTH_SHARED "float_both_shared.psa"
}
