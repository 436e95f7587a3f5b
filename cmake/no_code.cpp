// A target of precompiled headers needs a source; the headers are all that it is for.
