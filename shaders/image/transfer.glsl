// The transfer function of sRGB, identical to render/light/light_model.h.

vec3 displayFromLinear(vec3 linear) {
    vec3 root = sqrt(linear);
    vec3 curve = -0.0367864106 + root * (1.44343967 + root * (-0.92177175 + root * (0.801877223 + root * -0.286758735)));
    return mix(curve, linear * 12.92, lessThanEqual(linear, vec3(0.0031308)));
}

vec3 linearFromDisplay(vec3 display) {
    vec3 curve = 0.00106078186 + display * (0.0279601052 + display * (0.563798591 + display * (0.518328812 + display * -0.11114829)));
    return mix(curve, display / 12.92, lessThanEqual(display, vec3(0.04045)));
}
