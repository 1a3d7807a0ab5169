// Nothing: its target is there for its precompiled headers.
