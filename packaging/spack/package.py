# A recipe for Spack 1.0 and newer. Put this folder into a repository of your own:
#
#     spack repo create ~/spack-own own          # and `spack repo add` the folder that it names
#     mkdir -p FOLDER/packages/mezha && cp packaging/spack/package.py FOLDER/packages/mezha/
#     spack dev-build mezha@0.1.0                # builds the checkout that you stand in

from spack_repo.builtin.build_systems.generic import Package

from spack.package import *


class Mezha(Package):
    """Parallel contact of elastic bodies in the plane, without friction. The contact pressure lives on a boundary of its own;
    PETSc solves the saddle-point systems with multigrid."""

    license("MIT OR Apache-2.0")

    # There is no public archive yet; for `spack install` give `git` or `url` the place that you take the sources from.
    version("0.1.0")

    variant("int64", default=False, description="Indices of 64 bits: more than 429 million nodes")

    depends_on("c", type="build")
    depends_on("rust@1.89:", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("llvm+clang", type="build")  # libclang, with which bindgen reads C headers

    depends_on("mpi")
    # Multigrid of its own; MUMPS factorises, PTScotch divides meshes.
    depends_on("petsc@3.18:+mpi+mumps+ptscotch+double~complex")
    depends_on("petsc+int64", when="+int64")
    depends_on("petsc~int64", when="~int64")

    # The crate `mpi` knows Open MPI and MPICH; Open MPI alone is tested.
    conflicts("platform=windows")

    def setup_build_environment(self, env: EnvironmentModifications) -> None:
        env.set("PETSC_DIR", self.spec["petsc"].prefix)
        env.unset("PETSC_ARCH")
        env.set("MPICC", self.spec["mpi"].mpicc)
        env.prepend_path("PATH", self.spec["mpi"].prefix.bin)
        env.set("LIBCLANG_PATH", self.spec["llvm"].prefix.lib)
        env.set("MEZHA_COMMIT", "Spack {0}".format(self.spec.format("{name}@{version}/{hash:7}")))

    def install(self, spec, prefix):
        cargo = which("cargo", required=True)
        cargo("install", "--locked", "--no-track", "--path", ".", "--root", prefix)

        manual = join_path(self.stage.path, "manual")
        cargo("run", "--release", "--locked", "--example", "manual", "--", manual)
        install_tree(join_path(manual, "man1"), prefix.share.man.man1)
        install_tree(join_path(manual, "bash"), join_path(prefix.share, "bash-completion", "completions"))
        install_tree(join_path(manual, "zsh"), join_path(prefix.share, "zsh", "site-functions"))
        install_tree(join_path(manual, "fish"), join_path(prefix.share, "fish", "vendor_completions.d"))

        install_tree("cases", prefix.share.mezha.cases)
        mkdirp(prefix.share.mezha.docs)
        install("docs/*.schema.json", prefix.share.mezha.docs)
        install_tree("docs", prefix.share.doc.mezha.docs)

    @run_after("install")
    @on_package_attributes(run_tests=True)
    def check_install(self):
        mezha = Executable(join_path(self.prefix.bin, "mezha"))
        mezha("run", join_path(self.prefix.share.mezha.cases, "patch_flat"), "--out", join_path(self.stage.path, "patch_flat"))
