#include "files/session/session_texture.h"

#include <cmath>
#include <string>

#include "files/text/base64.h"

namespace chainmail {
namespace {

std::array<Point, 2> read_box(const SessionFields& fields, const nlohmann::json& texture) {
  const auto& numbers = fields.array(texture, "box");
  if (numbers.size() != 6) {
    fields.fail("'box' holds " + std::to_string(numbers.size()) + " numbers", "give its lowest and its highest corner");
  }
  std::array<Point, 2> box;
  for (std::size_t i = 0; i < 6; ++i) {
    box[i / 3][static_cast<Eigen::Index>(i % 3)] = fields.number(numbers[i]);
  }
  const Point extent = box[1] - box[0];
  if (!(box[0].cwiseAbs().maxCoeff() <= coordinate_limit && box[1].cwiseAbs().maxCoeff() <= coordinate_limit) ||
      !(extent.x() > 0 && extent.y() > 0 && extent.z() >= 0)) {
    fields.fail("'box' is none of a texture", "give its lowest and its highest corner");
  }
  return box;
}

}  // namespace

void write_session_texture(TextBlocks& out, const Texture& texture, const Progress& progress) {
  const auto& [low, high] = texture.box;
  const nlohmann::ordered_json json{{"size", texture.size},
                                    {"channels", texture.channels},
                                    {"box", {low.x(), low.y(), low.z(), high.x(), high.y(), high.z()}}};
  const std::string text = json.dump();
  out << std::string_view(text).substr(0, text.size() - 1) << ", \"texels\": \"";
  Base64Writer texels(out);
  for (std::size_t i = 0; i < texture.texels.size(); ++i) {
    progress.report(i, texture.texels.size());
    texels.add(texture.texels[i]);
  }
  texels.finish();
  out << "\"}";
}

std::shared_ptr<const Texture> read_session_texture(const SessionFields& fields, const nlohmann::json& mesh,
                                                    const Progress& progress) {
  if (!mesh.contains("texture")) {
    return nullptr;
  }
  progress.report(0);
  const auto& json = fields.object(mesh, "texture");
  fields.check_keys(json, {"size", "channels", "box", "texels"});
  const auto& size = fields.array(json, "size");
  Texture texture;
  double bytes = double(fields.count(json, "channels", 4));
  texture.channels = static_cast<int>(bytes);
  for (std::size_t k = 0; k < 3; ++k) {
    const bool whole = size.size() == 3 && size[k].is_number_unsigned() && size[k].get<std::uint64_t>() <= UINT32_MAX;
    texture.size[k] = whole ? size[k].get<std::uint32_t>() : 0;
    bytes *= texture.size[k];
  }
  if (bytes == 0 || (texture.channels != 1 && texture.channels != 4)) {
    fields.fail("the texture has no size [w, h, d] of texels with 1 or 4 channels", "give both");
  }
  texture.box = read_box(fields, json);
  const auto& text = fields.member(json, "texels");
  auto texels = text.is_string() ? from_base64(text.get_ref<const std::string&>()) : std::nullopt;
  if (!texels || double(texels->size()) != bytes) {
    fields.fail("'texels' does not hold one byte for each channel of each texel", "write them in base 64");
  }
  texture.texels = std::move(*texels);
  return std::make_shared<const Texture>(std::move(texture));
}

}  // namespace chainmail
