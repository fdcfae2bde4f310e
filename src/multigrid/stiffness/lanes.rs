//! Vector registers as sweeps use them: a few nodes side by side, two components each. Which instructions the processor has
//! is asked at run time; one without any of these works on short arrays.
//!
//! All operations are those of single numbers, but that vector instructions round a product and a sum together.

/// A kind of register that holds nodes side by side.
pub trait Lanes: Copy + 'static {
    /// The register.
    type Register: Copy;
    /// The same in memory.
    type Nodes: Copy + AsRef<[[f64; 2]]>;
    /// How many nodes: two or four.
    const COUNT: usize;

    /// Nodes in memory, as many as fill registers.
    fn chunks_mut(nodes: &mut [[f64; 2]]) -> &mut [Self::Nodes];

    /// A register from memory.
    fn load(self, nodes: Self::Nodes) -> Self::Register;

    /// A register of nodes that lie apart, by their places in it.
    fn gather(self, node: impl Fn(usize) -> [f64; 2]) -> Self::Register;

    /// A register to memory.
    fn store(self, register: Self::Register) -> Self::Nodes;

    /// `a + b`.
    fn add(self, a: Self::Register, b: Self::Register) -> Self::Register;

    /// `a b`, number by number.
    fn multiply(self, a: Self::Register, b: Self::Register) -> Self::Register;

    /// `a b + c`, number by number.
    fn multiply_add(self, a: Self::Register, b: Self::Register, c: Self::Register) -> Self::Register;

    /// The components of each node in the other order.
    fn turned(self, a: Self::Register) -> Self::Register;

    /// Does work with the instructions of these registers.
    fn run<W: LaneWork>(self, work: W);
}

/// Work on registers. All that it calls must be inlined: only so do instructions that not all processors have come to be.
pub trait LaneWork {
    /// Does it.
    fn work(self);
}

/// Arrays of two nodes, for processors without the instructions of the others.
#[derive(Clone, Copy)]
pub struct PlainLanes;

impl Lanes for PlainLanes {
    type Register = [f64; 4];
    type Nodes = [[f64; 2]; 2];
    const COUNT: usize = 2;

    #[inline(always)]
    fn chunks_mut(nodes: &mut [[f64; 2]]) -> &mut [Self::Nodes] {
        nodes.as_chunks_mut().0
    }

    #[inline(always)]
    fn load(self, [a, b]: Self::Nodes) -> Self::Register {
        [a[0], a[1], b[0], b[1]]
    }

    #[inline(always)]
    fn gather(self, node: impl Fn(usize) -> [f64; 2]) -> Self::Register {
        self.load([node(0), node(1)])
    }

    #[inline(always)]
    fn store(self, [a, b, c, d]: Self::Register) -> Self::Nodes {
        [[a, b], [c, d]]
    }

    #[inline(always)]
    fn add(self, a: Self::Register, b: Self::Register) -> Self::Register {
        std::array::from_fn(|i| a[i] + b[i])
    }

    #[inline(always)]
    fn multiply(self, a: Self::Register, b: Self::Register) -> Self::Register {
        std::array::from_fn(|i| a[i] * b[i])
    }

    #[inline(always)]
    fn multiply_add(self, a: Self::Register, b: Self::Register, c: Self::Register) -> Self::Register {
        std::array::from_fn(|i| a[i] * b[i] + c[i])
    }

    #[inline(always)]
    fn turned(self, [a, b, c, d]: Self::Register) -> Self::Register {
        [b, a, d, c]
    }

    #[inline(always)]
    fn run<W: LaneWork>(self, work: W) {
        work.work();
    }
}

/// Registers of x86 processors.
#[cfg(target_arch = "x86_64")]
mod x86 {
    use super::{LaneWork, Lanes};
    use pulp::x86::{V3, V4};
    use pulp::{NullaryFnOnce, cast, f64x4, f64x8};

    /// Two nodes, by the instructions AVX2 and FMA.
    #[derive(Clone, Copy)]
    pub struct Avx2Lanes(pub V3);

    /// Four nodes, by the instructions AVX-512.
    #[derive(Clone, Copy)]
    pub struct Avx512Lanes(pub V4);

    /// Work for one kind of processor.
    struct Call<W>(W);

    impl<W: LaneWork> NullaryFnOnce for Call<W> {
        type Output = ();

        #[inline(always)]
        fn call(self) {
            self.0.work();
        }
    }

    /// What is alike for all registers: sizes, memory.
    macro_rules! memory {
        ($register:ty, $count:literal) => {
            type Register = $register;
            type Nodes = [[f64; 2]; $count];
            const COUNT: usize = $count;

            #[inline(always)]
            fn chunks_mut(nodes: &mut [[f64; 2]]) -> &mut [Self::Nodes] {
                nodes.as_chunks_mut().0
            }

            #[inline(always)]
            fn load(self, nodes: Self::Nodes) -> Self::Register {
                cast(nodes)
            }

            #[inline(always)]
            fn gather(self, node: impl Fn(usize) -> [f64; 2]) -> Self::Register {
                cast(std::array::from_fn::<[f64; 2], $count, _>(node))
            }

            #[inline(always)]
            fn store(self, register: Self::Register) -> Self::Nodes {
                cast(register)
            }

            #[inline(always)]
            fn run<W: LaneWork>(self, work: W) {
                self.0.vectorize(Call(work));
            }
        };
    }

    /// Sums and products, by the names of the instructions.
    macro_rules! arithmetic {
        ($add:ident, $multiply:ident, $fused:ident, $sums:ident, $fma:ident) => {
            #[inline(always)]
            fn add(self, a: Self::Register, b: Self::Register) -> Self::Register {
                cast(self.0.$sums.$add(cast(a), cast(b)))
            }

            #[inline(always)]
            fn multiply(self, a: Self::Register, b: Self::Register) -> Self::Register {
                cast(self.0.$sums.$multiply(cast(a), cast(b)))
            }

            #[inline(always)]
            fn multiply_add(self, a: Self::Register, b: Self::Register, c: Self::Register) -> Self::Register {
                cast(self.0.$fma.$fused(cast(a), cast(b), cast(c)))
            }
        };
    }

    impl Lanes for Avx2Lanes {
        memory!(f64x4, 2);
        arithmetic!(_mm256_add_pd, _mm256_mul_pd, _mm256_fmadd_pd, avx, fma);

        #[inline(always)]
        fn turned(self, a: f64x4) -> f64x4 {
            cast(self.0.avx._mm256_permute_pd::<0b0101>(cast(a)))
        }
    }

    impl Lanes for Avx512Lanes {
        memory!(f64x8, 4);
        arithmetic!(_mm512_add_pd, _mm512_mul_pd, _mm512_fmadd_pd, avx512f, avx512f);

        #[inline(always)]
        fn turned(self, a: f64x8) -> f64x8 {
            cast(self.0.avx512f._mm512_permute_pd::<0b0101_0101>(cast(a)))
        }
    }
}

#[cfg(target_arch = "x86_64")]
pub use x86::{Avx2Lanes, Avx512Lanes};
