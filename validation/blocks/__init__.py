"""The reference cases of blocks: closed forms, prototypes, elastic blocks, sliding spectra."""
