// The alpha value that marks a lit pixel. The difference to 1 is invisible in a window. lit_count.frag counts the
// pixels with this value.
const float kLitAlpha = 254.0 / 255.0;
