//! Rooted trees: the order conditions of one-step methods. For tests of coefficients only.
//!
//! A Runge–Kutta method with weights b has order p if Σ b_i Φ_i(t) = 1/density(t) for every tree t of at most p
//! vertices; Φ is 1 for a leaf and Π_k Σ_j a_ij Φ_j(t_k) over the branches t_k. A Rosenbrock method has β in the place
//! of a wherever there is one branch only, and α elsewhere (Hairer and Wanner, *Solving Ordinary Differential Equations
//! II*, IV.7).

/// A rooted tree, by its branches.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Tree(Vec<Tree>);

impl Tree {
    /// Number of vertices.
    pub(crate) fn order(&self) -> usize {
        1 + self.0.iter().map(Tree::order).sum::<usize>()
    }

    /// Product of the orders of all subtrees.
    pub(crate) fn density(&self) -> f64 {
        self.0.iter().map(Tree::density).product::<f64>() * self.order() as f64
    }
}

/// All trees of at most `order` vertices.
pub(crate) fn up_to_order(order: usize) -> Vec<Tree> {
    let mut found = vec![Tree(Vec::new())];
    let mut newest = found.clone();
    for _ in 1..order {
        let mut next = Vec::new();
        for tree in &newest {
            grow(tree, &mut next);
        }
        next.sort();
        next.dedup();
        found.extend(next.iter().cloned());
        newest = next;
    }
    found
}

/// Pushes every tree that has one leaf more.
fn grow(tree: &Tree, into: &mut Vec<Tree>) {
    let mut more = tree.0.clone();
    more.push(Tree(Vec::new()));
    more.sort();
    into.push(Tree(more));
    for (i, branch) in tree.0.iter().enumerate() {
        let mut grown = Vec::new();
        grow(branch, &mut grown);
        for branch in grown {
            let mut branches = tree.0.clone();
            branches[i] = branch;
            branches.sort();
            into.push(Tree(branches));
        }
    }
}

/// Φ of each stage.
pub(crate) fn weights<const N: usize>(tree: &Tree, alpha: &[[f64; N]; N], beta: &[[f64; N]; N]) -> [f64; N] {
    let matrix = if tree.0.len() == 1 { beta } else { alpha };
    let branches: Vec<_> = tree.0.iter().map(|branch| weights(branch, alpha, beta)).collect();
    std::array::from_fn(|i| {
        branches.iter().map(|phi| (0..N).map(|j| matrix[i][j] * phi[j]).sum::<f64>()).product::<f64>()
    })
}

#[test]
fn there_are_seventeen_trees_of_up_to_five_vertices() {
    let count = |order| up_to_order(order).len();
    assert_eq!([1, 2, 3, 4, 5].map(count), [1, 2, 4, 8, 17]);
}
