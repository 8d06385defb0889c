// Copies a picture with its depths, darkened where light from all sides is hidden.
in vec2 place;

uniform sampler2D picture;   // colours multiplied by their opacity
uniform sampler2D depths;
uniform sampler2D occlusions; // at half the resolution
uniform float darkening;      // largest, 0 to 1

out vec4 fragment;

void main() {
  vec4 result = texelFetch(picture, ivec2(gl_FragCoord.xy), 0);
  if (result.a <= 0.0) {
    discard;
  }
  float depth = texelFetch(depths, ivec2(gl_FragCoord.xy), 0).r;
  if (darkening > 0.0) {
    // The mean over a block of 4 by 4, which takes four samples of 2 by 2. Samples must be at corners of pixels: anywhere
    // else, the pixels of the block would have different weights, and the pattern would stay as stripes.
    vec2 texels = vec2(textureSize(occlusions, 0));
    vec2 corner = round(place * texels);
    float hidden = 0.0;
    for (int i = 0; i < 4; ++i) {
      hidden += textureLod(occlusions, (corner + vec2(i % 2 == 0 ? -1.0 : 1.0, i < 2 ? -1.0 : 1.0)) / texels, 0.0).r;
    }
    result.rgb *= 1.0 - darkening * hidden / 4.0;
  }
  gl_FragDepth = depth;
  fragment = result;
}
