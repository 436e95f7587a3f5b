// The alpha of a pixel that the light reaches. A window sees no difference, and who counts such pixels does.
const float kLitAlpha = 254.0 / 255.0;
