// SPDX-License-Identifier: Apache-2.0
// Renders a scene to a PNG file:      render_a_scene [SCENE [FILE.png]]
// SCENE is a glTF or OBJ file, or a recipe such as "recipe:ring?alpha=0.1".
#include <image/png.h>
#include <image/tone_curve.h>
#include <real_time/frame.h>
#include <shot/open_shot.h>

#include <cstdio>
#include <memory>
#include <utility>

namespace {
int explain(const luciole::Error& error) {
  std::fprintf(stderr, "%s\n", error.message.c_str());
  return static_cast<int>(error.kind);
}
}  // namespace

int main(int argc, char** argv) {
  const auto shot = luciole::find_shot(argc > 1 ? argv[1] : "recipe:cornell", {});
  if (!shot) return explain(shot.error());
  auto opened = luciole::open_shot(*shot, {});  // also finds a camera and light where the scene has none
  if (!opened) return explain(opened.error());
  if (opened->primary.empty()) std::swap(opened->primary, opened->scene.lights);  // these cast indirect light

  luciole::Settings settings;
  settings.width = 320, settings.height = 240;
  settings.vpls = 16384;
  auto scene = std::make_shared<const luciole::Scene>(std::move(opened->scene));
  auto renderer = luciole::Renderer::create(scene, opened->camera, opened->primary, settings);
  if (!renderer) return explain(renderer.error());
  const auto frame = renderer->render(0, {}, luciole::ToneCurve::pbr_neutral);
  if (!frame) return explain(frame.error());

  const char* const name = argc > 2 ? argv[2] : "picture.png";
  const auto written = luciole::write_png_codes(frame->shown, frame->width, frame->height, name);
  if (!written) return explain(written.error());
  std::printf("%.1f ms, %zu triangles\n", frame->statistics.frame_ms, std::size_t(scene->triangle_count()));
}
