// Copies a picture without changes. Mesa's software OpenGL has a fast path for such a simple shader.
layout(binding = 0) uniform sampler2D picture;

layout(location = 0) in vec2 place;
layout(location = 0) out vec4 pixel;

void main() {
    pixel = texture(picture, place);
}
