// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_accessor.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

#include "scene/file_fault.h"

namespace luciole::gltf {
namespace {

std::uint32_t byte_size(ComponentType type) {
  switch (type) {
    case ComponentType::int8:
    case ComponentType::uint8:
      return 1;
    case ComponentType::int16:
    case ComponentType::uint16:
      return 2;
    default:
      return 4;
  }
}

ComponentType component_type_of(const JsonObject& object) {
  const std::uint64_t code = object.required_whole("componentType");
  if (code < 5120 || code > 5126 || code == 5124) {
    fail("VALUE_NOT_IN_LIST", object.label(), "has the unknown componentType " + std::to_string(code));
  }
  return static_cast<ComponentType>(code);
}

// Elements in memory. stride 0 repeats one zero element: accessors without bytes are all zeros.
struct Elements {
  const std::uint8_t* first = nullptr;
  std::uint64_t stride = 0;  // [byte]
};

// The bytes of `count` elements that start at byteOffset of a view, checked to lie inside the view.
Elements elements_in_view(Document& document, const JsonObject& object, std::uint64_t count,
                          std::uint64_t element_bytes) {
  const std::size_t view_index = object.required_reference("bufferView", document.count(kBufferViews));
  const BufferView view = document.buffer_view(view_index);
  const std::uint64_t offset = object.whole("byteOffset", 0);
  const std::uint64_t stride = view.stride == 0 ? element_bytes : view.stride;
  if (stride < element_bytes) {
    fail("ACCESSOR_SMALL_BYTESTRIDE", object.label(), "its elements are larger than the byteStride of " + view.label);
  }
  // count <= limits.vertices and stride <= 252 by earlier checks, offset <= 2^53: nothing wraps in 64 bits.
  const std::uint64_t end = offset + stride * (count - 1) + element_bytes;
  if (end > view.bytes.size()) {
    fail("ACCESSOR_TOO_LONG", object.label(),
         "ends at byte " + std::to_string(end) + " of " + view.label + ", which has " +
             std::to_string(view.bytes.size()));
  }
  return {view.bytes.data() + offset, stride};
}

template <class T>
T load(const std::uint8_t* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

template <class T>
float as_float(T value, bool normalised) {
  const auto number = static_cast<float>(value);
  if (!normalised) return number;
  return std::max(number / static_cast<float>(std::numeric_limits<T>::max()), -1.0f);
}

float float_at(const std::uint8_t* bytes, const AccessorShape& shape) {
  switch (shape.component_type) {
    case ComponentType::int8:
      return as_float(load<std::int8_t>(bytes), shape.normalised);
    case ComponentType::uint8:
      return as_float(load<std::uint8_t>(bytes), shape.normalised);
    case ComponentType::int16:
      return as_float(load<std::int16_t>(bytes), shape.normalised);
    case ComponentType::uint16:
      return as_float(load<std::uint16_t>(bytes), shape.normalised);
    case ComponentType::uint32:
      return static_cast<float>(load<std::uint32_t>(bytes));
    case ComponentType::float32:
      break;
  }
  return load<float>(bytes);
}

std::uint32_t index_at(const std::uint8_t* bytes, ComponentType type) {
  switch (type) {
    case ComponentType::uint8:
      return *bytes;
    case ComponentType::uint16:
      return load<std::uint16_t>(bytes);
    default:
      return load<std::uint32_t>(bytes);
  }
}

bool is_unsigned_integer(ComponentType type) {
  return type == ComponentType::uint8 || type == ComponentType::uint16 || type == ComponentType::uint32;
}

// Calls store(element index, bytes of the element) for the base values, then for the sparse replacements.
template <class Store>
void for_each_element(Document& document, std::size_t accessor, const AccessorShape& shape, const Store& store) {
  const JsonObject object = document.element(kAccessors, accessor);
  const std::uint64_t element_bytes = std::uint64_t(shape.components) * byte_size(shape.component_type);
  static constexpr std::uint8_t kZeros[64] = {};
  Elements base{kZeros, 0};
  if (object.has("bufferView")) {
    base = elements_in_view(document, object, shape.count, element_bytes);
  } else if (object.has("byteOffset")) {
    fail("UNSATISFIED_DEPENDENCY", object.label(), "has a byteOffset but no bufferView");
  }
  for (std::uint64_t i = 0; i < shape.count; ++i) store(i, base.first + i * base.stride);

  const std::optional<JsonObject> sparse = object.object("sparse");
  if (!sparse) return;
  const std::uint64_t replaced = sparse->required_whole("count");
  if (replaced == 0 || replaced > shape.count) {
    fail("ACCESSOR_SPARSE_COUNT_OUT_OF_RANGE", sparse->label(),
         "replaces " + std::to_string(replaced) + " of " + std::to_string(shape.count) + " elements");
  }
  const std::optional<JsonObject> indices = sparse->object("indices"), values = sparse->object("values");
  if (!indices || !values) fail("UNDEFINED_PROPERTY", sparse->label(), "lacks its indices or its values");
  const ComponentType index_type = component_type_of(*indices);
  if (!is_unsigned_integer(index_type))
    fail("VALUE_NOT_IN_LIST", indices->label(), "its indices are not unsigned integers");
  const Elements where = elements_in_view(document, *indices, replaced, byte_size(index_type));
  const Elements what = elements_in_view(document, *values, replaced, element_bytes);
  std::int64_t previous = -1;
  for (std::uint64_t i = 0; i < replaced; ++i) {
    const std::uint32_t index = index_at(where.first + i * where.stride, index_type);
    if (index >= shape.count) {
      fail("ACCESSOR_SPARSE_INDEX_OOB", indices->label(), "index " + std::to_string(index) + " is beyond the accessor");
    }
    if (index <= previous)
      fail("ACCESSOR_SPARSE_INDICES_NON_INCREASING", indices->label(), "its indices do not increase");
    previous = index;
    store(index, what.first + i * what.stride);
  }
}

// Before memory is taken. An accessor without bytes may claim any count.
void check_count(const Document& document, const AccessorShape& shape) {
  if (shape.count > document.limits().vertices) {
    fail("VALUE_NOT_IN_RANGE", shape.label,
         "has " + std::to_string(shape.count) + " elements; at most " + std::to_string(document.limits().vertices) +
             " are read");
  }
}

}  // namespace

void check_accessor_bytes(Document& document, std::size_t accessor) {
  for_each_element(document, accessor, accessor_shape(document, accessor), [](std::uint64_t, const std::uint8_t*) {});
}

AccessorShape accessor_shape(const Document& document, std::size_t accessor) {
  const JsonObject object = document.element(kAccessors, accessor);
  AccessorShape shape;
  shape.label = object.label();
  shape.component_type = component_type_of(object);
  shape.normalised = object.boolean("normalized", false);
  if (shape.normalised &&
      (shape.component_type == ComponentType::float32 || shape.component_type == ComponentType::uint32)) {
    fail("ACCESSOR_NORMALIZED_INVALID", shape.label, "only 8- and 16-bit integers can be normalised");
  }
  shape.count = object.required_whole("count");
  if (shape.count == 0) fail("VALUE_NOT_IN_RANGE", shape.label, "its count is zero");
  check_count(document, shape);
  const std::string type = object.text("type");
  if (type == "SCALAR") {
    shape.components = 1;
  } else if (type == "VEC2" || type == "VEC3" || type == "VEC4") {
    shape.components = static_cast<std::uint32_t>(type[3] - '0');
  } else if (type == "MAT4") {
    shape.components = 16;
  } else {
    fail("VALUE_NOT_IN_LIST", shape.label, "its type \"" + printable(type) + "\" is not one that can be read");
  }
  return shape;
}

std::vector<float> read_floats(Document& document, std::size_t accessor) {
  const AccessorShape shape = accessor_shape(document, accessor);
  std::vector<float> values(shape.count * shape.components);
  const std::uint32_t step = byte_size(shape.component_type);
  for_each_element(document, accessor, shape, [&](std::uint64_t element, const std::uint8_t* bytes) {
    for (std::uint32_t c = 0; c < shape.components; ++c) {
      const float value = float_at(bytes + c * step, shape);
      if (!std::isfinite(value)) {
        fail("ACCESSOR_INVALID_FLOAT", shape.label, "element " + std::to_string(element) + " is not a finite number");
      }
      values[element * shape.components + c] = value;
    }
  });
  return values;
}

std::vector<std::uint32_t> read_indices(Document& document, std::size_t accessor) {
  const AccessorShape shape = accessor_shape(document, accessor);
  if (shape.components != 1 || shape.normalised || !is_unsigned_integer(shape.component_type)) {
    fail("MESH_PRIMITIVE_INDICES_ACCESSOR_INVALID_FORMAT", shape.label, "indices must be unsigned integer scalars");
  }
  std::vector<std::uint32_t> values(shape.count);
  for_each_element(document, accessor, shape, [&](std::uint64_t element, const std::uint8_t* bytes) {
    values[element] = index_at(bytes, shape.component_type);
  });
  return values;
}

}  // namespace luciole::gltf
