// A picture as it is, and nothing else: Mesa's software OpenGL copies what a shader as plain as this one draws.
layout(binding = 0) uniform sampler2D picture;

layout(location = 0) in vec2 place;
layout(location = 0) out vec4 pixel;

void main() {
    pixel = texture(picture, place);
}
