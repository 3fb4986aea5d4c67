/// What compilers are told about inlining: for speed alone, the results are the same without. One that does not know
/// these attributes decides by itself.
#pragma once

#if defined(__GNUC__)
#define PAPERPROOF_INLINE [[gnu::always_inline]] inline
#define PAPERPROOF_INLINE_LAMBDA __attribute__((always_inline))  // after the parameters of a lambda
#define PAPERPROOF_NOT_INLINE [[gnu::noinline]]
#define PAPERPROOF_COLD [[gnu::cold, gnu::noinline]]  // seldom called: its instructions lie apart from the hot ones
#define PAPERPROOF_FLATTEN [[gnu::flatten]]           // all that it calls is inlined into it
#else
#define PAPERPROOF_INLINE inline
#define PAPERPROOF_INLINE_LAMBDA
#define PAPERPROOF_NOT_INLINE
#define PAPERPROOF_COLD
#define PAPERPROOF_FLATTEN
#endif
