// The alpha of a lit pixel. It is invisible in a window, and lit_count.frag counts such pixels.
const float kLitAlpha = 254.0 / 255.0;
