// SPDX-License-Identifier: GPL-2.0-or-later
#include "mesh_import.h"

#include <filesystem>

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include "furrow/core/error.h"
#include "furrow/io/formats/input_text.h"
#include "furrow/io/formats/mesh_file.h"

namespace furrow {

SolidMesh import_mesh(const std::string& path) {
  const std::string ending = lower_case(std::filesystem::path(path).extension().string());
  Assimp::Importer importer;
  const bool is_ours = ending == ".stl" || ending == ".obj" || ending == ".vtp";
  if (is_ours || !std::filesystem::is_regular_file(path) || !importer.IsExtensionSupported(ending))
    return read_mesh_file(path);
  // with the transformations of the nodes, the unit and the upward axis of the file
  const aiScene* scene =
      importer.ReadFile(path, aiProcess_Triangulate | aiProcess_PreTransformVertices);
  if (!scene)
    throw InputError(path, "cannot be read", "a whole mesh file: " + ending,
                     std::string("Assimp reports: ") + importer.GetErrorString());
  MeshFacets read;
  int facet = 0;
  for (unsigned int m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& mesh = *scene->mMeshes[m];
    const int first = static_cast<int>(read.points.size());
    for (unsigned int n = 0; n < mesh.mNumVertices; ++n)
      read.points.emplace_back(mesh.mVertices[n].x, mesh.mVertices[n].y, mesh.mVertices[n].z);
    for (unsigned int f = 0; f < mesh.mNumFaces; ++f) {
      std::vector<int> corners;
      for (unsigned int k = 0; k < mesh.mFaces[f].mNumIndices; ++k)
        corners.push_back(first + static_cast<int>(mesh.mFaces[f].mIndices[k]));
      read.add_polygon(corners, ++facet);
    }
  }
  return mesh_of_facets(path, read);
}

}  // namespace furrow
