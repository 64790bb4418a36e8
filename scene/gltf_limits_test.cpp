// SPDX-License-Identifier: Apache-2.0
// Every limit of the glTF reader: what lies within loads, what lies outside is refused by a sentence that names the
// file and the object. The controls are the files just inside.
#include <gtest/gtest.h>

#include <limits>

#include "scene/gltf_test_files.h"

namespace luciole::test {
namespace {

void expect_fault(const std::string& fault, const std::string& code, const std::string& object) {
  EXPECT_NE(fault.find(code), std::string::npos) << fault;
  EXPECT_NE(fault.find(object), std::string::npos) << fault;
  EXPECT_EQ(fault.find("made.gltf: "), 0u) << fault;
}

// Changes one thing of the square and expects its fault.
void expect_refused(const std::function<void(Json&)>& change, const std::string& code, const std::string& object) {
  Json file = square_file();
  change(file);
  expect_fault(fault_of(file), code, object);
}

TEST(GltfReader, loads_the_square_that_the_other_tests_break) {
  const Result<Scene> scene = load(square_file());
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->triangle_count(), 2u);
  EXPECT_EQ(scene->bounds().high.y, 1.0f);
}

TEST(GltfReader, refuses_accessors_beyond_their_view_in_64_bits) {
  expect_refused([](Json& f) { f["accessors"][0]["count"] = 5; }, "ACCESSOR_TOO_LONG", "accessor 0");
  expect_refused([](Json& f) { f["accessors"][0]["byteOffset"] = 4; }, "ACCESSOR_TOO_LONG", "accessor 0");
  // 12 * count wraps to 0 in 32 bits and to a small number in 64.
  expect_refused([](Json& f) { f["accessors"][0]["count"] = 357913942; }, "VALUE_NOT_IN_RANGE", "accessor 0");
  expect_refused([](Json& f) { f["accessors"][0]["byteOffset"] = 9007199254740992; }, "ACCESSOR_TOO_LONG",
                 "accessor 0");
  expect_refused([](Json& f) { f["accessors"][0]["count"] = 1e300; }, "TYPE_MISMATCH", "accessor 0");
}

TEST(GltfReader, refuses_views_beyond_their_buffer_and_buffers_beyond_their_data) {
  expect_refused([](Json& f) { f["bufferViews"][3]["byteLength"] = 13; }, "BUFFER_VIEW_TOO_LONG", "bufferView 3");
  expect_refused([](Json& f) { f["bufferViews"][3]["byteOffset"] = 9007199254740992; }, "BUFFER_VIEW_TOO_LONG",
                 "bufferView 3");
  expect_refused([](Json& f) { f["buffers"][0]["byteLength"] = 141; }, "BUFFER_BYTE_LENGTH_MISMATCH", "buffer 0");
  expect_refused([](Json& f) { f["bufferViews"][0]["byteStride"] = 8; }, "ACCESSOR_SMALL_BYTESTRIDE", "accessor 0");
  expect_refused([](Json& f) { f["bufferViews"][0]["byteStride"] = 14; }, "BUFFER_VIEW_INVALID_BYTE_STRIDE",
                 "bufferView 0");
}

TEST(GltfReader, refuses_indices_beyond_the_vertices) {
  Json file = square_file();
  file["accessors"][0]["count"] = 3;
  file["accessors"][1]["count"] = 3;
  file["accessors"][2]["count"] = 3;
  expect_fault(fault_of(file), "ACCESSOR_INDEX_OOB", "mesh 0, primitive 0");
}

TEST(GltfReader, refuses_attributes_of_different_lengths) {
  expect_refused([](Json& f) { f["accessors"][1]["count"] = 3; }, "MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT", "mesh 0");
}

// Replaces the x of the last corner by a sparse accessor with the given indices (16 bits) and expects a fault or none.
std::string sparse_fault(const std::vector<std::uint16_t>& indices) {
  Json file = square_file();
  Bytes bytes(indices.size() * 2 + indices.size() * 12);
  std::memcpy(bytes.data(), indices.data(), indices.size() * 2);
  const std::size_t index_bytes = indices.size() * 2;
  file["buffers"].push_back({{"byteLength", bytes.size()}, {"uri", data_uri("application/octet-stream", bytes)}});
  file["bufferViews"].push_back({{"buffer", 1}, {"byteLength", index_bytes}});
  file["bufferViews"].push_back(
      {{"buffer", 1}, {"byteOffset", index_bytes}, {"byteLength", bytes.size() - index_bytes}});
  file["accessors"][0]["sparse"] = {{"count", indices.size()},
                                    {"indices", {{"bufferView", 4}, {"componentType", 5123}}},
                                    {"values", {{"bufferView", 5}}}};
  return fault_of(file);
}

TEST(GltfReader, reads_sparse_accessors_whose_indices_increase_and_fit) {
  EXPECT_EQ(sparse_fault({1, 3}), "");
  expect_fault(sparse_fault({3, 1}), "ACCESSOR_SPARSE_INDICES_NON_INCREASING", "accessor 0, sparse");
  expect_fault(sparse_fault({1, 1}), "ACCESSOR_SPARSE_INDICES_NON_INCREASING", "accessor 0, sparse");
  expect_fault(sparse_fault({1, 4}), "ACCESSOR_SPARSE_INDEX_OOB", "accessor 0, sparse");
  expect_fault(sparse_fault({0, 1, 2, 3, 4}), "ACCESSOR_SPARSE_COUNT_OUT_OF_RANGE", "accessor 0, sparse");
}

// A chain of `length` nodes, the mesh at its end.
Json node_chain(std::size_t length) {
  Json file = square_file();
  file["nodes"] = Json::array();
  for (std::size_t i = 0; i + 1 < length; ++i) file["nodes"].push_back({{"children", {i + 1}}});
  file["nodes"].push_back({{"mesh", 0}});
  return file;
}

TEST(GltfReader, walks_1024_levels_of_nodes_and_no_more) {
  EXPECT_EQ(fault_of(node_chain(1024)), "");
  expect_fault(fault_of(node_chain(1025)), "VALUE_NOT_IN_RANGE", "node 1024");
  expect_fault(fault_of(node_chain(200000)), "VALUE_NOT_IN_RANGE", "node 1024");  // and without recursion
}

TEST(GltfReader, refuses_loops_and_second_parents) {
  expect_refused([](Json& f) { f["nodes"][0]["children"] = {0}; }, "NODE_LOOP", "node 0");
  Json loop = node_chain(3);
  loop["nodes"][2]["children"] = {1};
  expect_fault(fault_of(loop), "NODE_LOOP", "node 1");
  Json diamond = node_chain(3);
  diamond["nodes"][0]["children"] = {1, 2};
  expect_fault(fault_of(diamond), "NODE_PARENT_OVERRIDE", "node 2");
  Json inner = node_chain(2);
  inner["scenes"][0]["nodes"] = {1};
  expect_fault(fault_of(inner), "SCENE_NON_ROOT_NODE", "scene 0");
}

TEST(GltfReader, parses_64_levels_of_json_and_no_more) {
  const auto nested = [](std::size_t levels) {
    // The document itself is one level.
    return R"({"asset":{"version":"2.0"},"extras":)" + std::string(levels - 1, '[') + std::string(levels - 1, ']') +
           "}";
  };
  EXPECT_TRUE(load(nested(64)));
  const Result<Scene> deep = load(nested(65));
  ASSERT_FALSE(deep);
  expect_fault(deep.error().message, "INVALID_JSON", "64");
  EXPECT_FALSE(load(nested(1000000)));
  // Brackets inside strings do not count.
  EXPECT_TRUE(load(R"({"asset":{"version":"2.0"},"extras":"\")" + std::string(100, '[') + "\"}"));
}

TEST(GltfReader, reads_only_below_its_folder) {
  for (const char* uri : {"../secret.bin", "a/../../secret.bin", "/etc/passwd", "%2e%2e/secret.bin", "..%2Fsecret.bin",
                          "a\\..\\secret.bin", "file:///etc/passwd", "http://example.org/a.bin", "a%00b", ""}) {
    expect_refused([uri](Json& f) { f["buffers"][0]["uri"] = uri; }, "INVALID_URI", "buffer 0");
  }
  // Decoded once: this is a file whose name has a percent sign, and it does not exist here.
  expect_refused([](Json& f) { f["buffers"][0]["uri"] = "%252e%252e/a.bin"; }, "IO_ERROR", "%2e%2e/a.bin");
  expect_refused([](Json& f) { f["buffers"][0]["uri"] = "data:application/octet-stream;base64,A*=="; }, "INVALID_URI",
                 "buffer 0");
}

TEST(GltfReader, reads_regular_files_only) {
  EXPECT_FALSE(load_scene("/dev/zero.gltf"));
  EXPECT_FALSE(read_regular_file("/dev/zero", 100));
  EXPECT_FALSE(read_regular_file("/", 100));
  EXPECT_FALSE(read_regular_file("/etc/passwd", 1));  // larger than allowed
}

TEST(GltfReader, checks_the_size_of_images_before_it_decodes_them) {
  Json file = square_file();
  const std::size_t texture = add_texture(file, png_file(8, 4, Bytes(128, 255)));
  file["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", texture}};
  LoadLimits limits;
  limits.image_side = 8;
  EXPECT_EQ(fault_of(file, limits), "");
  limits.image_side = 7;
  expect_fault(fault_of(file, limits), "IMAGE_SIZE", "image 0");
  limits = {};
  limits.texels = 32;
  EXPECT_EQ(fault_of(file, limits), "");
  limits.texels = 31;
  expect_fault(fault_of(file, limits), "IMAGE_SIZE", "31");

  // A header that promises 16,385 pixels and brings none: were it decoded, the fault would be another.
  Bytes huge = png_file(8, 4, Bytes(128, 255));
  huge[18] = 0x40, huge[19] = 0x01;  // width, big-endian, at byte 16
  file["images"][0]["uri"] = data_uri("image/png", huge);
  EXPECT_FALSE(fault_of(file).empty());
}

TEST(GltfReader, refuses_positions_that_are_not_finite) {
  Json file = square_file();
  const float bad = std::numeric_limits<float>::quiet_NaN();
  Bytes bytes(48);
  std::memcpy(bytes.data() + 44, &bad, 4);
  file["buffers"].push_back({{"byteLength", 48}, {"uri", data_uri("application/octet-stream", bytes)}});
  file["bufferViews"][0] = {{"buffer", 1}, {"byteLength", 48}};
  expect_fault(fault_of(file), "ACCESSOR_INVALID_FLOAT", "accessor 0");
  // Finite in the file, infinite in the world.
  expect_refused([](Json& f) { f["nodes"][0]["scale"] = {1e38, 1e38, 1e38}; }, "VALUE_NOT_IN_RANGE", "node 0");
}

TEST(GltfReader, normalises_normals) {
  Json file = square_file();
  file["nodes"][0]["scale"] = {2, 3, 0.25};
  const Result<Scene> scene = load(file);
  ASSERT_TRUE(scene);
  for (const Vec3& normal : scene->meshes[0].normals) EXPECT_FLOAT_EQ(length(normal), 1.0f);
}

TEST(GltfReader, bounds_what_a_small_file_may_ask_for) {
  LoadLimits limits;
  limits.vertices = 1000;
  Json file = square_file();
  EXPECT_EQ(fault_of(file, limits), "");
  file["accessors"].push_back({{"componentType", 5126}, {"count", 1001}, {"type", "VEC3"}});
  expect_fault(fault_of(file, limits), "VALUE_NOT_IN_RANGE", "accessor 4");
  Json many = square_file();
  many["nodes"] = Json::array();
  many["scenes"][0]["nodes"] = Json::array();
  for (int i = 0; i < 200; ++i) {
    many["nodes"].push_back({{"mesh", 0}});
    many["scenes"][0]["nodes"].push_back(i);
  }
  EXPECT_EQ(fault_of(many), "");
  expect_fault(fault_of(many, limits), "VALUE_NOT_IN_RANGE", "vertices");
}

TEST(GltfReader, knows_which_extensions_it_can_do_without) {
  expect_refused([](Json& f) { f["extensionsRequired"] = {"KHR_draco_mesh_compression"}; }, "UNSUPPORTED_EXTENSION",
                 "KHR_draco_mesh_compression");
  Json file = square_file();
  file["extensionsUsed"] = {"VENDOR_a", "KHR_texture_transform", "VENDOR_a", "VENDOR_b"};
  const Result<Scene> scene = load(file);
  ASSERT_TRUE(scene);
  EXPECT_EQ(scene->warnings.size(), 2u);  // one for each that is unknown
}

TEST(GltfReader, refuses_other_versions) {
  expect_refused([](Json& f) { f["asset"]["version"] = "1.0"; }, "UNKNOWN_ASSET_MAJOR_VERSION", "asset");
  expect_refused([](Json& f) { f["asset"].erase("version"); }, "UNDEFINED_PROPERTY", "asset");
}

TEST(GltfReader, refuses_what_is_broken_where_nobody_looks) {
  expect_refused(
      [](Json& f) {
        f["meshes"].push_back({{"primitives", {{{"attributes", {{"POSITION", 9}}}}}}});
      },
      "UNRESOLVED_REFERENCE", "mesh 1");
  expect_refused([](Json& f) { f["skins"] = {{{"joints", {7}}}}; }, "UNRESOLVED_REFERENCE", "skin 0");
}

}  // namespace
}  // namespace luciole::test
