// SPDX-License-Identifier: Apache-2.0
#include "app/codecs/gltf_file.h"

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

#include "platform/camera.h"

namespace nt {
namespace {

// Puts arrays one after the other into the file's one buffer.
class Builder {
 public:
  explicit Builder(tinygltf::Model& model) : model_(model) { model_.buffers.emplace_back(); }

  // `target`: what a renderer does with it; 0: nothing, it is read only.
  int view(const void* bytes, std::size_t size, int target) {
    std::vector<unsigned char>& data = model_.buffers.front().data;
    data.resize((data.size() + 3) / 4 * 4);
    tinygltf::BufferView view;
    view.buffer = 0, view.byteOffset = data.size(), view.byteLength = size, view.target = target;
    data.resize(data.size() + size);
    std::memcpy(data.data() + view.byteOffset, bytes, size);
    model_.bufferViews.push_back(view);
    return static_cast<int>(model_.bufferViews.size()) - 1;
  }

  template <typename T>
  int accessor(const std::vector<T>& values, int component, int type, int target) {
    const auto parts = static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<uint32_t>(type)));
    tinygltf::Accessor accessor;
    accessor.bufferView = view(values.data(), values.size() * sizeof(T), target);
    accessor.componentType = component, accessor.type = type;
    accessor.count = values.size() / parts;
    model_.accessors.push_back(accessor);
    return static_cast<int>(model_.accessors.size()) - 1;
  }
  int floats(const std::vector<float>& values, int type, int target = 0) {
    return accessor(values, TINYGLTF_COMPONENT_TYPE_FLOAT, type, target);
  }
  // Positions and times must say between what they lie.
  int bounded(const std::vector<float>& values, int type, int target = 0) {
    const int index = floats(values, type, target);
    const auto parts = static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<uint32_t>(type)));
    tinygltf::Accessor& accessor = model_.accessors[static_cast<std::size_t>(index)];
    for (std::size_t k = 0; k < parts; ++k) {
      float least = values[k], most = values[k];
      for (std::size_t i = k; i < values.size(); i += parts)
        least = std::min(least, values[i]), most = std::max(most, values[i]);
      accessor.minValues.push_back(static_cast<double>(least)), accessor.maxValues.push_back(static_cast<double>(most));
    }
    return index;
  }

 private:
  tinygltf::Model& model_;
};

std::vector<float> flat(const std::vector<Vec3>& points) {
  std::vector<float> values;
  values.reserve(3 * points.size());
  for (const Vec3 p : points) values.insert(values.end(), {p.x, p.y, p.z});
  return values;
}

std::vector<float> flat(const std::vector<Vec2>& points) {
  std::vector<float> values;
  values.reserve(2 * points.size());
  for (const Vec2 p : points) values.insert(values.end(), {p.x, p.y});
  return values;
}

void add_texture(const SkinnedModel& source, Builder& builder, tinygltf::Model& model) {
  tinygltf::Image image;
  image.name = source.name, image.mimeType = "image/png";
  image.bufferView = builder.view(source.png.data(), source.png.size(), 0);
  model.images.push_back(image);
  tinygltf::Sampler sampler;
  sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR, sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
  sampler.wrapS = sampler.wrapT = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
  model.samplers.push_back(sampler);
  tinygltf::Texture texture;
  texture.source = texture.sampler = 0;
  model.textures.push_back(texture);
}

void add_material(const SkinnedModel& source, Builder& builder, tinygltf::Model& model) {
  tinygltf::Material material;
  material.name = source.name, material.doubleSided = true;
  if (!source.png.empty()) {
    add_texture(source, builder, model);
    material.pbrMetallicRoughness.baseColorTexture.index = 0;
  }
  material.pbrMetallicRoughness.metallicFactor = 0, material.pbrMetallicRoughness.roughnessFactor = 0.8;
  if (source.drawing) {
    material.alphaMode = "BLEND";
    material.extensions["KHR_materials_unlit"] = tinygltf::Value(tinygltf::Value::Object());
    model.extensionsUsed.emplace_back("KHR_materials_unlit");
  }
  model.materials.push_back(material);
}

void add_mesh(const SkinnedModel& source, Builder& builder, tinygltf::Model& model) {
  constexpr int kVertices = TINYGLTF_TARGET_ARRAY_BUFFER;
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES, primitive.material = 0;
  primitive.indices = builder.accessor(source.triangles, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR,
                                       TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
  primitive.attributes["POSITION"] = builder.bounded(flat(source.vertices), TINYGLTF_TYPE_VEC3, kVertices);
  if (!source.normals.empty())
    primitive.attributes["NORMAL"] = builder.floats(flat(source.normals), TINYGLTF_TYPE_VEC3, kVertices);
  if (!source.texcoords.empty())
    primitive.attributes["TEXCOORD_0"] = builder.floats(flat(source.texcoords), TINYGLTF_TYPE_VEC2, kVertices);
  std::vector<uint16_t> joints;
  std::vector<float> weights;
  for (const SkinVertex& vertex : source.skin) {
    joints.insert(joints.end(), vertex.joints.begin(), vertex.joints.end());
    weights.insert(weights.end(), vertex.weights.begin(), vertex.weights.end());
  }
  primitive.attributes["JOINTS_0"] =
      builder.accessor(joints, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_VEC4, kVertices);
  primitive.attributes["WEIGHTS_0"] = builder.floats(weights, TINYGLTF_TYPE_VEC4, kVertices);
  tinygltf::Mesh mesh;
  mesh.name = source.name;
  mesh.primitives.push_back(primitive);
  model.meshes.push_back(mesh);
}

// The joints are the first nodes, in their order; then the mesh.
void add_nodes(const SkinnedModel& source, Builder& builder, tinygltf::Model& model) {
  tinygltf::Skin skin;
  skin.name = source.name, skin.skeleton = 0;
  std::vector<float> inverse_bind;
  for (std::size_t i = 0; i < source.joints.size(); ++i) {
    const ModelJoint& joint = source.joints[i];
    tinygltf::Node node;
    node.name = joint.name;
    Vec3 at = joint.rest;
    if (joint.parent >= 0) {
      at = at - source.joints[static_cast<std::size_t>(joint.parent)].rest;
      model.nodes[static_cast<std::size_t>(joint.parent)].children.push_back(static_cast<int>(i));
    }
    node.translation = {static_cast<double>(at.x), static_cast<double>(at.y), static_cast<double>(at.z)};
    model.nodes.push_back(node);
    skin.joints.push_back(static_cast<int>(i));
    inverse_bind.insert(inverse_bind.end(),
                        {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -joint.rest.x, -joint.rest.y, -joint.rest.z, 1});
  }
  skin.inverseBindMatrices = builder.floats(inverse_bind, TINYGLTF_TYPE_MAT4);
  model.skins.push_back(skin);
  tinygltf::Node node;
  node.name = source.name, node.mesh = 0, node.skin = 0;
  model.nodes.push_back(node);
  tinygltf::Scene scene;
  scene.name = source.animation;
  scene.nodes = {0, static_cast<int>(source.joints.size())};
  model.scenes.push_back(scene);
  model.defaultScene = 0;
}

bool moves(const ModelJoint& joint, Vec3 rest) {
  constexpr float kStill = 1e-7f;  // of the distance from the parent, and in the file's units
  return std::any_of(joint.at.begin(), joint.at.end(),
                     [&](Vec3 at) { return length(at - rest) > kStill * (1 + length(rest)); });
}

// x, y, z, w of each key; nothing where the joint never turns.
std::vector<float> rotations(const ModelJoint& joint, Vec3 axis) {
  std::vector<Quat> keys = joint.turn;
  for (const float turn : joint.turn_rad) {
    const double half = 0.5 * static_cast<double>(turn);
    const Vec3 part = axis * static_cast<float>(std::sin(half));
    keys.push_back({static_cast<float>(std::cos(half)), part.x, part.y, part.z});
  }
  const bool turns = std::any_of(keys.begin(), keys.end(), [](Quat key) { return length(axis_part(key)) > 0.5e-7f; });
  std::vector<float> values;
  for (const Quat key : keys) values.insert(values.end(), {key.x, key.y, key.z, key.w});
  return turns ? values : std::vector<float>{};
}

void add_animation(const SkinnedModel& source, Builder& builder, tinygltf::Model& model) {
  tinygltf::Animation animation;
  animation.name = source.animation;
  const int times = builder.bounded(source.times_s, TINYGLTF_TYPE_SCALAR);
  const auto add = [&](std::size_t joint, const char* path, int keys) {
    tinygltf::AnimationSampler sampler;
    sampler.input = times, sampler.output = keys, sampler.interpolation = "LINEAR";
    animation.samplers.push_back(sampler);
    tinygltf::AnimationChannel channel;
    channel.sampler = static_cast<int>(animation.samplers.size()) - 1;
    channel.target_node = static_cast<int>(joint), channel.target_path = path;
    animation.channels.push_back(channel);
  };
  for (std::size_t i = 0; i < source.joints.size(); ++i) {
    const ModelJoint& joint = source.joints[i];
    const std::vector<double>& rest = model.nodes[i].translation;
    if (moves(joint, {static_cast<float>(rest[0]), static_cast<float>(rest[1]), static_cast<float>(rest[2])}))
      add(i, "translation", builder.floats(flat(joint.at), TINYGLTF_TYPE_VEC3));
    const std::vector<float> turns = rotations(joint, source.axis);
    if (!turns.empty()) add(i, "rotation", builder.floats(turns, TINYGLTF_TYPE_VEC4));
  }
  if (!animation.channels.empty()) model.animations.push_back(animation);
}

}  // namespace

std::vector<uint8_t> write_glb_bytes(const SkinnedModel& source) {
  tinygltf::Model model;
  model.asset.version = "2.0", model.asset.generator = "neontetra " NEONTETRA_VERSION;
  model.asset.extras = tinygltf::Value(tinygltf::Value::Object{{"frame", tinygltf::Value(source.note)}});
  Builder builder(model);
  add_material(source, builder, model);
  add_mesh(source, builder, model);
  add_nodes(source, builder, model);
  add_animation(source, builder, model);
  std::ostringstream stream;
  tinygltf::TinyGLTF writer;
  if (!writer.WriteGltfSceneToStream(&model, stream, false, true)) throw UserError("tinygltf could not write the GLB");
  const std::string bytes = stream.str();
  return {bytes.begin(), bytes.end()};
}

}  // namespace nt
