// Overlays that visualise the method. OVERLAY: 1 partitions, 2 texels, 3 aliasing, 4 lod, 5 clusters, 6 projection, 7
// residency.

// The C++ file render/overlay/overlay_colors.cpp has the same colours and explains their choice.
vec3 indexColor(int index) {
    const vec3 colors[8] = vec3[](
        vec3(0.74, 0.57, 0.29), vec3(0.49, 0.12, 0.1), vec3(0.75, 0.9, 0.47), vec3(0.2, 0.38, 0.53),
        vec3(0.96, 0.99, 0.93), vec3(0.26, 0.03, 0.35), vec3(0.21, 0.8, 0.76), vec3(0.09, 0.54, 0.46));
    return colors[uint(index) % 8u]; // unsigned, because the index is -1 for a surface without a map
}

// Returns the colour of a factor: dark blue up to 1/4, grey at 1, orange at 4 and pale yellow from 16.
vec3 heat(float value) {
    float x = clamp(log2(max(value, 1e-6)) * 0.5, -1.0, 2.0);
    vec3 kept = mix(vec3(0.03, 0.09, 0.36), vec3(0.37, 0.4, 0.44), clamp(x + 1.0, 0.0, 1.0));
    vec3 above = mix(kept, vec3(0.86, 0.57, 0.18), clamp(x, 0.0, 1.0));
    return mix(above, vec3(1.0, 0.99, 0.86), clamp(x - 1.0, 0.0, 1.0));
}

// Returns the striped colour of a surface without a shadow map. The stripes are four pixels wide.
vec3 withoutMap(float lightness) {
    ivec2 at = ivec2(gl_FragCoord.xy);
    return vec3(lightness) * ((at.x + at.y) / 4 % 2 == 0 ? 0.35 : 0.55);
}

// Returns the perspective aliasing along the map axis where it is larger: the width of a texel's beam of light divided
// by the width of a pixel's beam.
float aliasing(Partition part, vec3 position, float depth) {
    vec4 clip = clipOf(part, position);
    vec4 dx = part.clipFromOffset * vec4(part.axisX, 0.0);
    vec4 dz = part.clipFromOffset * vec4(part.axisZ, 0.0);
    vec2 perX = abs(dx.xy * clip.w - clip.xy * dx.w) * part.texelScale;
    vec2 perZ = abs(dz.xy * clip.w - clip.xy * dz.w) * part.texelScale;
    // In a transposed map, x changes only the row. Therefore z is measured along columns.
    float texels = min(max(perX.x, perX.y), perX.y > perX.x ? perZ.x : perZ.y) / (clip.w * clip.w);
    return 1.0 / (max(texels, 1e-30) * pixelSlope * depth);
}

// Returns the projection aliasing: cosine to the eye divided by cosine to the light (Lloyd et al. 2006, Eq 1).
float projection(vec3 position, vec3 normal) {
    return max(dot(normal, normalize(eye - position)), 0.0) / max(dot(normal, lightAt(position).xyz), 1e-6);
}

// Returns 1 on the lines of a grid of five texels, antialiased if a texel is smaller than a pixel.
float texelGrid(Partition part, vec3 position) {
    vec2 at = (texelOf(part, clipOf(part, position)) - part.firstTexel) / 5.0;
    vec2 wide = max(fwidth(at), vec2(1e-6));
    vec2 line = 1.0 - smoothstep(vec2(0.5), vec2(1.5), abs(fract(at - 0.5) - 0.5) / wide);
    vec2 density = clamp(1.5 - 3.0 * wide, 0.0, 1.0); // fades a grid that is finer than pixels, because it would alias
    return max(line.x * density.x, line.y * density.y);
}

// Returns the colour of the residency overlay. Blue: the error is small enough; yellow: the finer group is not in
// memory; dark red: the finer group cannot be read.
vec3 residence(float reason) {
    return reason < 0.5 ? vec3(0.35, 0.55, 0.75) : reason < 1.5 ? vec3(1.0, 0.85, 0.3) : vec3(0.55, 0.05, 0.1);
}

vec3 overlay(vec3 shaded, vec3 position, vec3 normal, float depth, int index, float error, uint cluster) {
    float lightness = dot(shaded, vec3(0.3, 0.5, 0.2));
#if OVERLAY == 1
    return index < 0 ? withoutMap(lightness) : indexColor(index) * (0.7 + 0.3 * lightness);
#elif OVERLAY == 2
    if (index < 0) return shaded * 0.8;
    return mix(mix(shaded, indexColor(index) * (0.3 + lightness), 0.25), vec3(0.0, 0.05, 0.1), 0.85 * texelGrid(partitionAt(index), position));
#elif OVERLAY == 3
    return index < 0 ? withoutMap(lightness) : heat(aliasing(partitionAt(index), position, depth)) * (0.8 + 0.2 * lightness);
#elif OVERLAY == 4
    return heat(error / (pixelSlope * depth) / max(errorPixels, 1e-6)) * (0.8 + 0.2 * lightness);
#elif OVERLAY == 5
    return indexColor(int(cluster)) * (0.7 + 0.3 * lightness);
#elif OVERLAY == 6
    return index < 0 ? withoutMap(lightness) : heat(projection(position, normal)) * (0.8 + 0.2 * lightness);
#elif OVERLAY == 7
    return residence(drawnResidence) * (0.7 + 0.3 * lightness);
#else
    return shaded;
#endif
}
